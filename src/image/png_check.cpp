// Based on: "Portable Network Graphics (PNG) Specification (Second Edition)", W3C Recommendation, 2003, Sec. 5.3 (chunk
// layout) and Annex D (checksum).
#include "image/png_check.h"

#include <cstddef>
#include <cstdint>

#include <fstream>
#include <iterator>
#include <string_view>

namespace lkao::image {
namespace {

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";

std::uint32_t big_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char byte : bytes.substr(0, 4)) value = value << 8 | static_cast<unsigned char>(byte);
  return value;
}

std::uint32_t checksum(std::string_view bytes) {
  std::uint32_t sum = 0xffffffffu;
  for (const char byte : bytes) {
    sum ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ ((sum & 1) != 0 ? 0xedb88320u : 0u);
  }
  return ~sum;
}

}  // namespace

std::string find_png_damage(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string start(kSignature.size(), '\0');
  if (!file.read(start.data(), static_cast<std::streamsize>(start.size())) || start != kSignature) return "";
  return find_png_damage_in(start + std::string(std::istreambuf_iterator<char>(file), {}));
}

std::string find_png_damage_in(std::string_view bytes) {
  if (!bytes.starts_with(kSignature)) return "";
  // Chunks: length of the data (4 bytes), type (4), data, checksum of type and data (4).
  std::string_view left = bytes.substr(kSignature.size());
  while (left.size() >= 12) {
    const std::size_t length = big_endian(left);
    if (left.size() - 12 < length) break;
    const std::string_view type_and_data = left.substr(4, 4 + length);
    if (checksum(type_and_data) != big_endian(left.substr(8 + length))) return "the PNG file is damaged";
    if (type_and_data.starts_with("IEND")) return "";
    left.remove_prefix(12 + length);
  }
  return "the PNG file is cut off";
}

}  // namespace lkao::image
