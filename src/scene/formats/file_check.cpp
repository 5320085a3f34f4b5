#include "scene/formats/file_check.h"

#include <cstdint>
#include <stdexcept>

#include <fmt/format.h>

namespace lkao::scene {

namespace {

std::uint32_t read_uint32(std::string_view bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[offset + i]);
  return value;
}

// Binary STL: 80 bytes of anything ("solid" too), a count, and 50 bytes a triangle.
std::optional<std::size_t> check_stl(std::string_view bytes) {
  const std::size_t promised = bytes.size() >= 84 ? read_uint32(bytes, 80) : 0;
  const bool is_whole_binary = bytes.size() >= 84 && bytes.size() == 84 + 50 * promised;
  if (is_whole_binary) return promised;
  if (!bytes.starts_with("solid") && !bytes.starts_with("SOLID")) {
    throw std::runtime_error(
        fmt::format("truncated or malformed STL: {} bytes, but the {} triangles of its header take {}", bytes.size(),
                    promised, 84 + 50 * promised));
  }
  // Text that ends between two facets is taken by assimp without a word.
  const std::size_t last_facet = bytes.rfind("endfacet");
  const std::size_t last_end = bytes.rfind("endsolid");
  if (last_end == bytes.npos || (last_facet != bytes.npos && last_end < last_facet)) {
    throw std::runtime_error("truncated or malformed STL: there is no \"endsolid\" behind the last facet");
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::size_t> check_file(std::string_view bytes, const std::string& extension) {
  if (extension == "stl") return check_stl(bytes);
  return std::nullopt;
}

}  // namespace lkao::scene
