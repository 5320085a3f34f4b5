// OFF: the word OFF, three counts, a line for every vertex, a line for every face.
#include <algorithm>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "scene/formats/readers.h"
#include "scene/formats/text.h"

namespace lkao::scene {

namespace {

using Words = std::vector<std::string_view>;

// The lines of a text as words; comments and blank lines left out.
class WordLines {
 public:
  explicit WordLines(std::string_view text) : rest_(text) {}

  // False at the end of the text.
  bool next(Words& words) {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      split(rest_.substr(0, std::min(end, rest_.substr(0, end).find('#'))), words);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      if (!words.empty()) return true;
    }
    return false;
  }

 private:
  static void split(std::string_view line, Words& words) {
    constexpr std::string_view kBlanks = " \t\r\v\f";
    words.clear();
    for (std::size_t begin = line.find_first_not_of(kBlanks); begin != line.npos;) {
      const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
      words.push_back(line.substr(begin, end - begin));
      begin = line.find_first_not_of(kBlanks, end);
    }
  }

  std::string_view rest_;
};

struct OffHeader {
  bool homogeneous = false;  // four coordinates a vertex, the fourth a divisor
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

OffHeader read_header(WordLines& lines) {
  Words words;
  if (!lines.next(words) || !words[0].ends_with("OFF") || words[0].size() > 7) {
    throw std::runtime_error("malformed OFF: the word OFF is missing");
  }
  std::string_view kind = words[0].substr(0, words[0].size() - 3);
  if (kind.find('n') != kind.npos) throw std::runtime_error("OFF of another dimension than 3 is not supported");
  OffHeader header;
  header.homogeneous = kind.find('4') != kind.npos;
  words.erase(words.begin());
  if (!words.empty() && words[0] == "BINARY") throw std::runtime_error("binary OFF is not supported");
  // The counts stand on the same line or on the next; that of the edges is often left out.
  if (words.empty() && !lines.next(words)) throw std::runtime_error("truncated OFF: there are no counts");
  if (words.size() < 2) throw std::runtime_error("malformed OFF: the counts of vertices and faces are missing");
  header.vertex_count = parse_count(words[0], "the count of vertices");
  header.face_count = parse_count(words[1], "the count of faces");
  return header;
}

glm::dvec3 parse_position(const Words& words, bool homogeneous, std::size_t vertex) {
  const std::size_t needed = homogeneous ? 4 : 3;
  if (words.size() < needed) {
    throw std::runtime_error(fmt::format("vertex {} has {} of {} coordinates", vertex, words.size(), needed));
  }
  glm::dvec3 position(parse_number(words[0]), parse_number(words[1]), parse_number(words[2]));
  if (homogeneous) position /= parse_number(words[3]);
  return position;
}

void add_face(FileMesh& mesh, const Words& words, std::size_t face, std::vector<std::uint32_t>& polygon) {
  const std::size_t corner_count = parse_count(words[0], "a face's count of corners");
  if (words.size() - 1 < corner_count) {
    throw std::runtime_error(fmt::format("face {} has {} of {} corners", face, words.size() - 1, corner_count));
  }
  polygon.clear();
  for (std::size_t i = 1; i <= corner_count; ++i) {
    const std::size_t index = parse_count(words[i], "a face's index");
    if (index >= mesh.positions.size()) {
      throw std::runtime_error(
          fmt::format("face {} names vertex {}, but there are only {} vertices", face, index, mesh.positions.size()));
    }
    polygon.push_back(static_cast<std::uint32_t>(index));
  }
  mesh.add_polygon(polygon);
}

}  // namespace

FileMesh read_off(std::string_view bytes) {
  WordLines lines(bytes);
  const OffHeader header = read_header(lines);
  FileMesh mesh;
  Words words;
  for (std::size_t i = 0; i < header.vertex_count; ++i) {
    if (!lines.next(words)) {
      throw std::runtime_error(fmt::format("truncated: {} of {} vertices", i, header.vertex_count));
    }
    mesh.positions.push_back(parse_position(words, header.homogeneous, i));
  }
  std::vector<std::uint32_t> polygon;
  for (std::size_t i = 0; i < header.face_count; ++i) {
    if (!lines.next(words)) throw std::runtime_error(fmt::format("truncated: {} of {} faces", i, header.face_count));
    add_face(mesh, words, i, polygon);
  }
  return mesh;
}

}  // namespace lkao::scene
