#include "scene/formats/ply_header.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "scene/formats/text.h"

namespace lkao::scene::ply {

namespace {

Type parse_type(std::string_view word) {
  struct Name {
    std::string_view word;
    Type type;
  };
  constexpr Name kNames[] = {
      {"char", Type::int8},      {"int8", Type::int8},       {"uchar", Type::uint8},   {"uint8", Type::uint8},
      {"short", Type::int16},    {"int16", Type::int16},     {"ushort", Type::uint16}, {"uint16", Type::uint16},
      {"int", Type::int32},      {"int32", Type::int32},     {"uint", Type::uint32},   {"uint32", Type::uint32},
      {"int64", Type::int64},    {"uint64", Type::uint64},   {"float", Type::float32}, {"float32", Type::float32},
      {"double", Type::float64}, {"float64", Type::float64},
  };
  for (const Name& name : kNames) {
    if (word == name.word) return name.type;
  }
  throw std::runtime_error(fmt::format("malformed PLY header: unknown property type \"{}\"", word));
}

Encoding parse_encoding(std::string_view line) {
  const std::string_view word = take_word(line);
  if (word == "ascii") return Encoding::ascii;
  if (word == "binary_little_endian") return Encoding::little_endian;
  if (word == "binary_big_endian") return Encoding::big_endian;
  throw std::runtime_error(fmt::format("malformed PLY header: unknown format \"{}\"", word));
}

Element parse_element(std::string_view line) {
  Element element;
  element.name = take_word(line);
  const double count = parse_number(take_word(line));
  if (!(count >= 0 && count <= std::numeric_limits<std::uint32_t>::max())) {
    throw std::runtime_error(fmt::format("malformed PLY header: {} elements \"{}\"", count, element.name));
  }
  element.count = static_cast<std::size_t>(count);
  return element;
}

Property parse_property(std::string_view line) {
  Property property;
  std::string_view word = take_word(line);
  if (word == "list") {
    property.is_list = true;
    property.count_type = parse_type(take_word(line));
    word = take_word(line);
  }
  property.type = parse_type(word);
  property.name = take_word(line);
  return property;
}

// Other comments may begin with that word too.
void parse_comment(std::string_view line, Header& header) {
  const std::string_view keyword = take_word(line);
  if (keyword == "TextureFile") {
    skip_blanks(line);
    header.textures.push_back(printable(line));
  }
  if (keyword != "origin") return;
  glm::dvec3 point;
  try {
    for (int axis = 0; axis < 3; ++axis) point[axis] = parse_number(take_word(line));
  } catch (const std::runtime_error&) {
    return;
  }
  if (take_word(line).empty()) header.origin = point;
}

// Lines may end in any way, each in its own. But behind a header whose lines end in CR alone, an LF is binary data.
class HeaderLines {
 public:
  explicit HeaderLines(std::string_view bytes) : rest_(bytes) {}

  std::string_view next() {
    const std::size_t end = rest_.find_first_of("\r\n");
    if (end == rest_.npos) throw std::runtime_error("truncated PLY: the header has no end");
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end);
    rest_.remove_prefix(rest_.starts_with("\r\n") && !ends_in_cr_ ? 2 : 1);
    ends_in_cr_ = line.data()[end] == '\r' && line.data() + end + 1 == rest_.data();
    return line;
  }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  bool ends_in_cr_ = false;  // the last line, and in nothing else
};

void check_vertices(const Header& header) {
  for (const Element& element : header.elements) {
    if (element.name != "vertex") continue;
    for (const char* axis : {"x", "y", "z"}) {
      if (!element.has(axis)) throw std::runtime_error(fmt::format("malformed PLY header: vertices have no {}", axis));
    }
    return;
  }
  throw std::runtime_error("malformed PLY header: there is no element \"vertex\"");
}

}  // namespace

std::size_t Element::index_of(std::string_view property) const {
  const auto is_it = [&](const Property& other) { return other.name == property && !other.is_list; };
  return static_cast<std::size_t>(std::find_if(properties.begin(), properties.end(), is_it) - properties.begin());
}

Header parse_header(std::string_view bytes) {
  bytes = without_byte_order_mark(bytes);
  if (!bytes.starts_with("ply") && !bytes.starts_with("PLY")) {
    throw std::runtime_error("malformed PLY: it does not begin with \"ply\"");
  }
  Header header;
  HeaderLines lines(bytes);
  bool has_format = false;
  while (true) {
    std::string_view line = lines.next();
    const std::string_view keyword = take_word(line);
    if (keyword == "end_header") break;
    if (keyword == "format") {
      header.encoding = parse_encoding(line);
      has_format = true;
    } else if (keyword == "element") {
      header.elements.push_back(parse_element(line));
    } else if (keyword == "property") {
      if (header.elements.empty()) throw std::runtime_error("malformed PLY header: a property before any element");
      header.elements.back().properties.push_back(parse_property(line));
    } else if (keyword == "comment") {
      parse_comment(line, header);
    }
  }
  if (!has_format) throw std::runtime_error("malformed PLY header: the format line is missing");
  check_vertices(header);
  header.data = lines.rest();
  return header;
}

}  // namespace lkao::scene::ply
