// STL, text and binary: triangles one by one, each with its own corners.
#include <algorithm>
#include <bit>
#include <cstring>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "scene/formats/readers.h"
#include "scene/formats/text.h"
#include "scene/formats/vertex_joiner.h"

namespace lkao::scene {

namespace {

constexpr std::size_t kHeaderSize = 84;  // a title of 80 bytes (which may say "solid"), the count of triangles
constexpr std::size_t kTriangleSize = 50;

// Numbers are little-endian.
std::uint32_t read_uint32(std::string_view bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[offset + i]);
  return value;
}

std::size_t promised_size(std::string_view bytes) {
  return kHeaderSize + kTriangleSize * (bytes.size() < kHeaderSize ? 0 : read_uint32(bytes, 80));
}

FileMesh read_binary(std::string_view bytes) {
  if (bytes.size() < kHeaderSize) {
    throw std::runtime_error(
        fmt::format("truncated or malformed STL: {} bytes, but a header takes {}", bytes.size(), kHeaderSize));
  }
  const std::size_t triangle_count = read_uint32(bytes, 80);
  if (bytes.size() < promised_size(bytes)) {
    throw std::runtime_error(
        fmt::format("truncated or malformed STL: {} bytes, but the {} triangles of its header take {}", bytes.size(),
                    triangle_count, promised_size(bytes)));
  }
  // Programs that write as they go may never come back to their header.
  const std::size_t possible_count = (bytes.size() - kHeaderSize) / kTriangleSize;
  if (triangle_count == 0 && possible_count > 0) {
    throw std::runtime_error(
        fmt::format("malformed STL: its header promises no triangles, but there is room for {}", possible_count));
  }
  FileMesh mesh;
  VertexJoiner joiner(mesh.positions);
  mesh.triangles.reserve(triangle_count);
  for (std::size_t i = 0; i < triangle_count; ++i) {
    // A normal, three corners, two bytes of anything.
    glm::uvec3 triangle;
    for (int corner = 0; corner < 3; ++corner) {
      glm::dvec3 position;
      for (int axis = 0; axis < 3; ++axis) {
        const std::size_t number = 3 + 3 * static_cast<std::size_t>(corner) + static_cast<std::size_t>(axis);
        position[axis] =
            static_cast<double>(std::bit_cast<float>(read_uint32(bytes, kHeaderSize + kTriangleSize * i + 4 * number)));
      }
      triangle[corner] = joiner.index_of(position);
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

class TextReader {
 public:
  explicit TextReader(std::string_view text) : text_(text), rest_(text) {}

  FileMesh read() {
    try {
      while (take()) read_statement();
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("line {}: {}", line_number(), error.what()));
    }
    if (is_in_solid_) {
      throw std::runtime_error("truncated or malformed STL: there is no \"endsolid\" behind the last facet");
    }
    if (!has_solid_ && mesh_.triangles.empty()) {
      throw std::runtime_error("truncated or malformed STL: neither text nor as long as a binary one");
    }
    return std::move(mesh_);
  }

 private:
  // Takes the next word; false at the end of the text.
  bool take() {
    word_ = take_word(rest_);
    return !word_.empty();
  }
  // As what must follow.
  void take_inside(const char* what) {
    if (!take()) throw std::runtime_error(fmt::format("truncated: the text ends in a {}", what));
  }
  bool is(std::string_view keyword) const { return equal_but_for_case(word_, keyword); }
  // "endloop" or "end loop".
  bool is_end_of(std::string_view what) {
    if (is("end")) {
      std::string_view behind = rest_;
      if (!equal_but_for_case(lkao::scene::take_word(behind), what)) return false;
      rest_ = behind;
      return true;
    }
    return word_.size() == 3 + what.size() && equal_but_for_case(word_.substr(0, 3), "end") &&
           equal_but_for_case(word_.substr(3), what);
  }
  // Titles may have any words in them.
  void skip_line() {
    if (!rest_.empty() && rest_[0] != '\n' && rest_[0] != '\r') {
      std::string_view line;
      take_line(rest_, line);
    }
  }

  void read_statement() {
    if (is("solid")) {
      has_solid_ = is_in_solid_ = true;
      skip_line();
    } else if (is_end_of("solid")) {
      is_in_solid_ = false;
      skip_line();
    } else if (is("facet")) {
      read_facet();
    } else if (is("outer") || is("loop") || is("vertex") || is_end_of("loop") || is_end_of("facet")) {
      throw std::runtime_error(fmt::format("\"{}\" outside of a facet", word_));
    } else {
      skip_line();  // colours and the like of some programs
    }
  }

  // The normal is not read: it says no more than the corners, and is often none ("-1.#IND").
  void read_facet() {
    do take_inside("facet");
    while (!is("outer") && !is("vertex") && !is("facet") && !is_end_of("facet"));
    while (is("outer")) {
      read_loop();
      take_inside("facet");
    }
    if (!is_end_of("facet")) throw std::runtime_error(fmt::format("\"{}\" in a facet", word_.substr(0, 40)));
  }

  void read_loop() {
    take_inside("loop");
    if (!is("loop")) throw std::runtime_error(fmt::format("\"{}\" behind \"outer\"", word_.substr(0, 40)));
    polygon_.clear();
    for (take_inside("loop"); is("vertex"); take_inside("loop")) {
      glm::dvec3 position;
      for (int axis = 0; axis < 3; ++axis) {
        take_inside("vertex");
        position[axis] = parse_number(word_);
      }
      polygon_.push_back(joiner_.index_of(position));
    }
    if (!is_end_of("loop")) throw std::runtime_error(fmt::format("\"{}\" in a loop", word_.substr(0, 40)));
    mesh_.add_polygon(polygon_);
  }

  std::size_t line_number() const {
    std::string_view before = text_.substr(0, text_.size() - rest_.size());
    std::string_view line;
    std::size_t number = 0;
    while (take_line(before, line)) ++number;
    return number;
  }

  std::string_view text_;
  std::string_view rest_;
  std::string_view word_;
  bool has_solid_ = false;
  bool is_in_solid_ = false;
  FileMesh mesh_;
  VertexJoiner joiner_{mesh_.positions};
  std::vector<std::uint32_t> polygon_;
};

// Text has no zero bytes; the count and the first triangles of a binary file, if not its title, have.
bool is_text(std::string_view bytes) {
  if (bytes.size() >= kHeaderSize && bytes.size() == promised_size(bytes)) return false;
  return bytes.substr(0, 1024).find('\0') == bytes.npos;
}

}  // namespace

FileMesh read_stl(std::string_view bytes) {
  return is_text(bytes) ? TextReader(without_byte_order_mark(bytes)).read() : read_binary(bytes);
}

}  // namespace lkao::scene
