// OFF: the word OFF, three counts, the vertices, the faces. A stream of numbers, in which line ends matter only where a
// record has more numbers than it needs, such as colours.
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scene/formats/readers.h"
#include "scene/formats/text.h"

namespace lkao::scene {

namespace off {
namespace {

// The words of a text, comments left out.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  // The next word, of whatever line; empty at the end of the text.
  std::string_view next() {
    while (true) {
      const std::string_view word = take_word(line_);
      if (!word.empty() || !next_line()) return word;
    }
  }
  // The next word of the same line; empty at its end.
  std::string_view next_of_line() { return take_word(line_); }
  void end_line() { line_ = {}; }

  std::size_t bytes_left() const { return line_.size() + text_.size(); }
  // Whether there are so many lines with words behind this one.
  bool has_lines(std::size_t count) const {
    Words rest(text_);
    while (count > 0 && !rest.next().empty()) {
      rest.end_line();
      --count;
    }
    return count == 0;
  }

 private:
  bool next_line() {
    if (!take_line(text_, line_)) return false;
    line_ = line_.substr(0, line_.find('#'));
    return true;
  }

  std::string_view text_;
  std::string_view line_;
};

struct Header {
  bool is_homogeneous = false;  // four coordinates a vertex, the fourth a divisor
  bool has_normals = false;
  bool has_texture_coordinates = false;
  std::size_t numbers_per_vertex = 3;
  std::size_t vertex_count = 0;
  std::size_t face_count = 0;
};

std::size_t parse_count(std::string_view word, const char* what) {
  const double value = parse_number(word);
  if (!(value >= 0 && value < 4294967296.0 && value == static_cast<double>(static_cast<std::uint64_t>(value)))) {
    throw std::runtime_error(fmt::format("{} is {}", what, word));
  }
  return static_cast<std::size_t>(value);
}

// [ST][C][N][4][n]OFF. A vertex has its position, a normal, a colour of four numbers and two texture coordinates.
void parse_keyword(std::string_view kind, Header& header) {
  const auto takes = [&](std::string_view letters) {
    const bool has = kind.starts_with(letters);
    if (has) kind.remove_prefix(letters.size());
    return has;
  };
  header.has_texture_coordinates = takes("ST");
  const bool has_colours = takes("C");
  header.has_normals = takes("N");
  header.is_homogeneous = takes("4");
  if (takes("n")) throw std::runtime_error("OFF of another dimension than 3 is not supported");
  if (!kind.empty()) throw std::runtime_error("malformed OFF: the word OFF is missing");
  header.numbers_per_vertex = 3u + (header.is_homogeneous ? 1 : 0) + (header.has_normals ? 3 : 0) +
                              (has_colours ? 4 : 0) + (header.has_texture_coordinates ? 2 : 0);
}

// The word behind the keyword, which may be glued to it; the keyword itself may be missing.
std::string_view parse_beginning(Words& words, Header& header) {
  const std::string_view word = words.next();
  std::size_t end = word.find("OFF");
  if (end == word.npos && word.starts_with("off")) end = 0;
  if (end == word.npos) {
    if (word.empty() || !is_number(word)) throw std::runtime_error("malformed OFF: the word OFF is missing");
    return word;
  }
  parse_keyword(word.substr(0, end), header);
  const std::string_view glued = word.substr(end + 3);
  const std::string_view first = glued.empty() ? words.next() : glued;
  if (first == "BINARY") throw std::runtime_error("binary OFF is not supported");
  if (first.empty()) throw std::runtime_error("truncated OFF: there are no counts");
  return first;
}

// The count of edges may be missing; where counts stand on lines of their own, it stands alone too.
void skip_edge_count(Words& words, bool counts_have_lines) {
  if (!counts_have_lines) {
    words.next_of_line();
    return;
  }
  Words ahead = words;
  if (ahead.next().empty() || !ahead.next_of_line().empty()) return;
  words = ahead;
}

Header read_header(Words& words) {
  Header header;
  header.vertex_count = parse_count(parse_beginning(words, header), "the count of vertices");
  std::string_view word = words.next_of_line();
  const bool counts_have_lines = word.empty();
  if (counts_have_lines) word = words.next();
  if (word.empty()) throw std::runtime_error("malformed OFF: the counts of vertices and faces are missing");
  header.face_count = parse_count(word, "the count of faces");
  skip_edge_count(words, counts_have_lines);
  return header;
}

void read_vertex(Words& words, const Header& header, std::size_t vertex, std::vector<double>& numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::string_view word = words.next();
    if (!word.empty()) {
      numbers[i] = parse_number(word);
    } else if (i == 0) {
      throw std::runtime_error(fmt::format("truncated: {} of {} vertices", vertex, header.vertex_count));
    } else {
      throw std::runtime_error(fmt::format("vertex {} has {} of {} coordinates", vertex, i, numbers.size()));
    }
  }
}

// The last two of a vertex' numbers; what stands in front of them on the line, colours, is of any number.
glm::vec2 read_uv(Words& words) {
  std::string_view last_but_one, last;
  for (std::string_view word = words.next_of_line(); !word.empty(); word = words.next_of_line()) {
    last_but_one = std::exchange(last, word);
  }
  if (last_but_one.empty()) return glm::vec2(std::numeric_limits<float>::quiet_NaN());
  return from_lower_left(parse_number(last_but_one), parse_number(last));
}

void read_vertices(Words& words, const Header& header, bool wants_uvs, FileMesh& mesh) {
  // A position takes six bytes at least, blanks included.
  mesh.positions.reserve(std::min(header.vertex_count, words.bytes_left() / 6));
  // Where vertices have lines of their own, colours may be of any number or missing.
  const bool have_lines = words.has_lines(header.vertex_count + header.face_count);
  const std::size_t coordinate_count = header.is_homogeneous ? 4 : 3;
  std::vector<double> numbers(have_lines ? coordinate_count + (header.has_normals ? 3 : 0) : header.numbers_per_vertex);
  for (std::size_t i = 0; i < header.vertex_count; ++i) {
    read_vertex(words, header, i, numbers);
    if (wants_uvs) {
      mesh.uvs.push_back(have_lines ? read_uv(words) : from_lower_left(numbers.end()[-2], numbers.back()));
    }
    if (have_lines) words.end_line();
    const glm::dvec3 position(numbers[0], numbers[1], numbers[2]);
    mesh.positions.push_back(header.is_homogeneous ? position / numbers[3] : position);
    if (!header.has_normals) continue;
    const double* const normal = &numbers[coordinate_count];
    mesh.normals.emplace_back(normal[0], normal[1], normal[2]);
  }
}

void read_face(Words& words, const Header& header, std::size_t face, FileMesh& mesh,
               std::vector<std::uint32_t>& corners) {
  const std::string_view count_word = words.next();
  if (count_word.empty()) throw std::runtime_error(fmt::format("truncated: {} of {} faces", face, header.face_count));
  const std::size_t corner_count = parse_count(count_word, "a face's count of corners");
  corners.clear();
  while (corners.size() < corner_count) {
    const std::string_view word = words.next();
    if (word.empty()) {
      throw std::runtime_error(fmt::format("face {} has {} of {} corners", face, corners.size(), corner_count));
    }
    const std::size_t index = parse_count(word, "a face's index");
    if (index >= mesh.positions.size()) {
      throw std::runtime_error(
          fmt::format("face {} names vertex {}, but there are only {} vertices", face, index, mesh.positions.size()));
    }
    corners.push_back(static_cast<std::uint32_t>(index));
  }
  words.end_line();
  mesh.add_polygon(corners);
}

}  // namespace
}  // namespace off

FileMesh read_off(std::string_view bytes, std::optional<int> uv_set) {
  off::Words words(without_byte_order_mark(bytes));
  const off::Header header = off::read_header(words);
  FileMesh mesh;
  const bool wants_uvs = header.has_texture_coordinates && uv_set == 0;
  off::read_vertices(words, header, wants_uvs, mesh);
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 0; i < header.face_count; ++i) off::read_face(words, header, i, mesh, corners);
  if (header.has_normals) mesh.normal_corners = mesh.triangles;
  if (wants_uvs) mesh.uv_corners = mesh.triangles;
  if (header.has_texture_coordinates) mesh.contents.uv_set_count = 1;
  return mesh;
}

}  // namespace lkao::scene
