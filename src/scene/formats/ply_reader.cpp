// PLY: a header that lists elements (vertex, face, ...) with their properties, then the records of each.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "scene/formats/readers.h"
#include "scene/formats/text.h"

namespace lkao::scene {

namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(Type type) {
  constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

Type parse_type(std::string_view word) {
  constexpr std::array<std::array<std::string_view, 2>, 8> kNames = {{{"char", "int8"},
                                                                      {"uchar", "uint8"},
                                                                      {"short", "int16"},
                                                                      {"ushort", "uint16"},
                                                                      {"int", "int32"},
                                                                      {"uint", "uint32"},
                                                                      {"float", "float32"},
                                                                      {"double", "float64"}}};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (word == kNames[i][0] || word == kNames[i][1]) return static_cast<Type>(i);
  }
  throw std::runtime_error(fmt::format("malformed PLY header: unknown property type \"{}\"", word));
}

struct Property {
  std::string name;
  Type type = Type::float32;
  bool is_list = false;
  Type count_type = Type::uint8;  // of a list's count
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { ascii, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
  std::string_view data;  // behind the header
};

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

Header parse_header(std::string_view bytes) {
  if (!bytes.starts_with("ply") && !bytes.starts_with("PLY")) {
    throw std::runtime_error("malformed PLY: it does not begin with \"ply\"");
  }
  Header header;
  bool has_format = false;
  while (true) {
    const std::size_t end = bytes.find('\n');
    if (end == bytes.npos) throw std::runtime_error("truncated PLY: the header has no end");
    std::string_view line = bytes.substr(0, end);
    bytes.remove_prefix(end + 1);
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
    }
  }
  if (!has_format) throw std::runtime_error("malformed PLY header: the format line is missing");
  header.data = bytes;
  return header;
}

struct EndOfData {};  // thrown by ValueReader where a value is not all there

// Takes one value after another from the data.
class ValueReader {
 public:
  ValueReader(std::string_view data, Encoding encoding) : rest_(data), encoding_(encoding) {}

  // Every PLY type fits a double without loss.
  double read(Type type) {
    if (encoding_ == Encoding::ascii) {
      const std::string_view word = take_word(rest_);
      if (word.empty()) throw EndOfData{};
      return parse_number(word);
    }
    if (rest_.size() < size_of(type)) throw EndOfData{};
    switch (type) {
      case Type::int8:
        return take<std::int8_t>();
      case Type::uint8:
        return take<std::uint8_t>();
      case Type::int16:
        return take<std::int16_t>();
      case Type::uint16:
        return take<std::uint16_t>();
      case Type::int32:
        return take<std::int32_t>();
      case Type::uint32:
        return take<std::uint32_t>();
      case Type::float32:
        return static_cast<double>(take<float>());
      case Type::float64:
        return take<double>();
    }
    return 0;
  }

  // What is left, to see a senseless count before memory is asked for.
  std::size_t bytes_left() const { return rest_.size(); }

 private:
  template <typename T>
  T take() {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), rest_.data(), sizeof(T));
    rest_.remove_prefix(sizeof(T));
    constexpr bool kNativeIsLittle = std::endian::native == std::endian::little;
    if ((encoding_ == Encoding::little_endian) != kNativeIsLittle) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
  }

  std::string_view rest_;
  Encoding encoding_;
};

void read_list(ValueReader& reader, const Property& property, std::vector<double>& values) {
  const double count = reader.read(property.count_type);
  if (!(count >= 0)) throw std::runtime_error(fmt::format("a list of {} entries", count));
  if (count > static_cast<double>(reader.bytes_left())) throw EndOfData{};
  values.resize(static_cast<std::size_t>(count));
  for (double& value : values) value = reader.read(property.type);
}

void skip(ValueReader& reader, const Property& property, std::vector<double>& scratch) {
  if (property.is_list) {
    read_list(reader, property, scratch);
  } else {
    reader.read(property.type);
  }
}

std::uint32_t to_index(double value, const Element& element, std::size_t record) {
  if (!(value >= 0 && value <= std::numeric_limits<std::uint32_t>::max() && value == std::floor(value))) {
    throw std::runtime_error(fmt::format("{} {} names vertex {}", element.name, record, value));
  }
  return static_cast<std::uint32_t>(value);
}

// A strip turns the order of corners around at every step; -1 begins a new strip.
void add_strip(FileMesh& mesh, const std::vector<double>& strip, const Element& element, std::size_t record) {
  std::vector<std::uint32_t> run;
  for (double value : strip) {
    if (value == -1.0) {
      run.clear();
      continue;
    }
    run.push_back(to_index(value, element, record));
    const std::size_t n = run.size();
    if (n < 3) continue;
    const bool odd = n % 2 == 0;
    mesh.triangles.emplace_back(run[odd ? n - 2 : n - 3], run[odd ? n - 3 : n - 2], run[n - 1]);
  }
}

void read_vertex(ValueReader& reader, const Element& element, FileMesh& mesh, std::vector<double>& scratch) {
  glm::dvec3 position(0.0);
  for (const Property& property : element.properties) {
    const std::size_t axis = std::string_view("xyz").find(property.name);
    if (property.name.size() == 1 && axis < 3 && !property.is_list) {
      position[static_cast<glm::dvec3::length_type>(axis)] = reader.read(property.type);
    } else {
      skip(reader, property, scratch);
    }
  }
  mesh.positions.push_back(position);
}

void read_face(ValueReader& reader, const Element& element, std::size_t record, FileMesh& mesh,
               std::vector<double>& scratch, std::vector<std::uint32_t>& polygon) {
  for (const Property& property : element.properties) {
    skip(reader, property, scratch);
    if (!property.is_list || (property.name != "vertex_indices" && property.name != "vertex_index")) continue;
    if (element.name == "tristrips") {
      add_strip(mesh, scratch, element, record);
      continue;
    }
    polygon.clear();
    for (double value : scratch) polygon.push_back(to_index(value, element, record));
    mesh.add_polygon(polygon);
  }
}

void read_element(ValueReader& reader, const Element& element, FileMesh& mesh) {
  if (element.properties.empty()) return;
  // No record takes less than a byte: a count from a damaged header reserves no more than the file's size.
  if (element.name == "vertex") mesh.positions.reserve(std::min(element.count, reader.bytes_left()));
  if (element.name == "face") mesh.triangles.reserve(std::min(element.count, reader.bytes_left()));
  std::vector<double> scratch;
  std::vector<std::uint32_t> polygon;
  for (std::size_t record = 0; record < element.count; ++record) {
    try {
      if (element.name == "vertex") {
        read_vertex(reader, element, mesh, scratch);
      } else if (element.name == "face" || element.name == "tristrips") {
        read_face(reader, element, record, mesh, scratch, polygon);
      } else {
        for (const Property& property : element.properties) skip(reader, property, scratch);
      }
    } catch (const EndOfData&) {
      throw std::runtime_error(
          fmt::format("truncated: the file ends in {} {} of {}", element.name, record, element.count));
    }
  }
}

void check_vertices(const Header& header) {
  for (const Element& element : header.elements) {
    if (element.name != "vertex") continue;
    for (const char* axis : {"x", "y", "z"}) {
      const auto is_axis = [&](const Property& property) { return property.name == axis && !property.is_list; };
      if (std::none_of(element.properties.begin(), element.properties.end(), is_axis)) {
        throw std::runtime_error(fmt::format("malformed PLY header: vertices have no {}", axis));
      }
    }
    return;
  }
  throw std::runtime_error("malformed PLY header: there is no element \"vertex\"");
}

}  // namespace

FileMesh read_ply(std::string_view bytes) {
  const Header header = parse_header(bytes);
  check_vertices(header);
  ValueReader reader(header.data, header.encoding);
  FileMesh mesh;
  for (const Element& element : header.elements) read_element(reader, element, mesh);
  return mesh;
}

}  // namespace lkao::scene
