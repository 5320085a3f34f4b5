#include "bench/report/store.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>

#include "image/atomic_file.h"

namespace lkao::bench {
namespace {

using nlohmann::ordered_json;

constexpr const char* kProgramKey = "program";

std::optional<std::string> read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(file), {});
}

}  // namespace

ReportStore::ReportStore(const std::string& folder, std::string program)
    : folder_(folder + "/measured"), program_(std::move(program)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw std::runtime_error(fmt::format("{}: cannot be made: {}", folder_, error.message()));
}

std::string ReportStore::path_of(const std::string& name, const char* ending) const {
  std::string file = name;
  for (char& c : file) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.';
    if (!is_plain) c = '_';
  }
  return fmt::format("{}/{}{}", folder_, file, ending);
}

std::optional<ordered_json> ReportStore::find(const std::string& name) const {
  const std::optional<std::string> text = read(path_of(name, ".json"));
  if (!text) return std::nullopt;
  ordered_json values = ordered_json::parse(*text, nullptr, false);
  if (!values.is_object() || values.value(kProgramKey, std::string()) != program_) return std::nullopt;
  return values;
}

void ReportStore::put(const std::string& name, const ordered_json& values) const {
  ordered_json all = values;
  all[kProgramKey] = program_;
  image::write_file(path_of(name, ".json"), all.dump(1) + "\n");
}

std::optional<std::vector<float>> ReportStore::find_picture(const std::string& name, std::size_t pixel_count) const {
  const std::optional<std::string> bytes = read(path_of(name, ".f32"));
  if (!bytes || bytes->size() != pixel_count * sizeof(float)) return std::nullopt;
  std::vector<float> picture(pixel_count);
  std::copy(bytes->begin(), bytes->end(), reinterpret_cast<char*>(picture.data()));
  return picture;
}

void ReportStore::put_picture(const std::string& name, const std::vector<float>& picture) const {
  const auto* const bytes = reinterpret_cast<const char*>(picture.data());
  image::write_file(path_of(name, ".f32"), std::string(bytes, picture.size() * sizeof(float)));
}

std::string fingerprint(std::string_view bytes) {
  // FNV-1a.
  std::uint64_t hash = 14695981039346656037u;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return fmt::format("{:016x}", hash);
}

std::string program_fingerprint() { return fingerprint(read("/proc/self/exe").value_or("")); }

}  // namespace lkao::bench
