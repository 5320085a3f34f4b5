#include "cli/part_file.h"

#include <array>
#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "cli/json_output.h"
#include "lkao/version.h"
#include "scene/holes.h"

namespace lkao::cli {
namespace {

constexpr const char* kFormat = "lkao part";
constexpr std::size_t kLongestHeader = std::size_t{1} << 20;
constexpr std::uint64_t kAnswers = 0x73726577736e61;  // "answers"

// FNV-1a, 4 bytes at a time: tells files that were changed by accident from those that were not.
class Fingerprint {
 public:
  template <typename Value>
  void add(std::span<const Value> values) {
    static_assert(std::is_trivially_copyable_v<Value> && sizeof(Value) % 4 == 0);
    add_word(values.size());
    const auto* const bytes = reinterpret_cast<const unsigned char*>(values.data());
    for (std::size_t at = 0; at < values.size_bytes(); at += 4) {
      std::uint32_t word = 0;
      std::memcpy(&word, bytes + at, sizeof word);
      add_word(word);
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  void add_word(std::uint64_t word) { value_ = (value_ ^ word) * 0x100000001b3; }

  std::uint64_t value_ = 0xcbf29ce484222325;
};

// What images, corners and materials say.
void add_holes(const scene::Holes& holes, Fingerprint& fingerprint) {
  fingerprint.add(std::span(holes.triangles));
  for (const scene::HoleMaterial& material : holes.materials) {
    const double numbers[] = {material.cut_off ? 1.0 : 0.0, material.cut_off.value_or(0), material.factor};
    fingerprint.add(std::span<const double>(numbers));
    if (!material.texture) continue;
    const int look[] = {static_cast<int>(material.texture->wraps.u), static_cast<int>(material.texture->wraps.v),
                        material.texture->is_smooth ? 1 : 0};
    fingerprint.add(std::span<const int>(look));
    const std::vector<std::uint16_t>& alphas = material.texture->image->alphas;
    fingerprint.add(std::span<const std::uint32_t>(std::vector<std::uint32_t>(alphas.begin(), alphas.end())));
  }
}

template <typename Value>
void write_values(std::ofstream& file, std::span<const Value> values) {
  file.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size_bytes()));
}

template <typename Value>
bool read_values(std::ifstream& file, std::span<Value> values) {
  file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size_bytes()));
  return static_cast<bool>(file);
}

// Of a share: what comes before its values.
using Numbers = std::array<std::uint64_t, 9>;

PartHeader header_of(const Json& document) {
  if (document.at("format") != kFormat) throw std::runtime_error("it is no part");
  if (const std::string by = document.at("version"); by != version()) {
    throw std::runtime_error(fmt::format("it was made by lkao {}, and this is {}", by, version()));
  }
  PartHeader header{{document.at("part"), document.at("parts")}, document.at("arguments")};
  const Part& part = header.part;
  if (part.count < 1 || part.number < 1 || part.number > part.count || header.arguments.empty()) {
    throw std::runtime_error("it is no part");
  }
  return header;
}

}  // namespace

// number - 1 of count equal shares; receivers are no more than 2^40, parts no more than 2^16.
std::size_t Part::first_of(std::size_t receiver_count) const {
  return receiver_count * static_cast<std::size_t>(number - 1) / static_cast<std::size_t>(count);
}

std::size_t Part::end_of(std::size_t receiver_count) const {
  return receiver_count * static_cast<std::size_t>(number) / static_cast<std::size_t>(count);
}

std::uint64_t fingerprint_of(const scene::Mesh& mesh) {
  Fingerprint fingerprint;
  fingerprint.add(std::span(mesh.positions));
  fingerprint.add(std::span(mesh.triangles));
  fingerprint.add(std::span(mesh.objects));
  if (mesh.holes) add_holes(*mesh.holes, fingerprint);
  return fingerprint.value();
}

std::uint64_t fingerprint_of(std::span<const Receiver> receivers) {
  Fingerprint fingerprint;
  fingerprint.add(receivers);
  return fingerprint.value();
}

PartWriter::PartWriter(std::string path, const PartHeader& header)
    : path_(std::move(path)), part_(header.part), file_(path_, std::ios::binary) {
  const Json document = {{"format", kFormat},
                         {"version", version()},
                         {"part", header.part.number},
                         {"parts", header.part.count},
                         {"arguments", header.arguments}};
  file_ << document.dump() << '\n';
}

void PartWriter::write(const PartAnswers& answers) {
  const QueryReport& report = answers.report;
  const Numbers numbers = {kAnswers,
                           answers.scene,
                           answers.receivers,
                           answers.occlusion.size(),
                           answers.bent_normals.size(),
                           report.receiver_count,
                           report.invalid_receiver_count,
                           report.ray_count,
                           report.blocked_ray_count};
  write_values(file_, std::span<const std::uint64_t>(numbers));
  write_values(file_, std::span(answers.occlusion));
  write_values(file_, std::span(answers.bent_normals));
}

void PartWriter::close() {
  file_.close();
  if (!file_) throw std::runtime_error(fmt::format("cannot write '{}'", path_));
}

PartReader::PartReader(std::string path) : path_(std::move(path)), file_(path_, std::ios::binary) {
  if (!file_) throw std::runtime_error(fmt::format("cannot read '{}'", path_));
  std::string line;
  for (char letter = 0; file_.get(letter) && letter != '\n' && line.size() < kLongestHeader;) line += letter;
  try {
    header_ = header_of(Json::parse(line));
  } catch (const Json::exception&) {
    fail("it is no part");
  } catch (const std::runtime_error& error) {
    fail(error.what());
  }
}

PartAnswers PartReader::read(std::size_t count) {
  Numbers numbers{};
  if (!read_values(file_, std::span<std::uint64_t>(numbers)) || numbers[0] != kAnswers)
    fail("it is cut off, or of another scene");
  if (numbers[3] != count || (numbers[4] != 0 && numbers[4] != count)) fail("it is of another scene");
  PartAnswers answers{.scene = numbers[1],
                      .receivers = numbers[2],
                      .report = {numbers[5], numbers[6], numbers[7], numbers[8]},
                      .occlusion = std::vector<float>(count),
                      .bent_normals = std::vector<glm::vec3>(numbers[4])};
  if (!read_values(file_, std::span(answers.occlusion)) || !read_values(file_, std::span(answers.bent_normals))) {
    fail("it is cut off");
  }
  return answers;
}

void PartReader::fail(const std::string& fault) const { throw std::runtime_error(path_ + ": " + fault); }

}  // namespace lkao::cli
