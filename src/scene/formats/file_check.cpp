#include "scene/formats/file_check.h"

#include <cstdint>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace lkao::scene {

namespace {

using nlohmann::json;

std::uint32_t read_uint32(std::string_view bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[offset + i]);
  return value;
}

// Triangles that a glTF primitive of so many indices makes, by its mode.
std::size_t count_primitive_triangles(int mode, std::size_t index_count) {
  constexpr int kTriangles = 4;
  constexpr int kTriangleStrip = 5;
  constexpr int kTriangleFan = 6;
  if (mode == kTriangles) {
    if (index_count % 3 != 0) throw std::runtime_error(fmt::format("a list of triangles has {} indices", index_count));
    return index_count / 3;
  }
  return (mode == kTriangleStrip || mode == kTriangleFan) && index_count >= 3 ? index_count - 2 : 0;
}

std::size_t count_gltf_triangles(const json& gltf) {
  std::size_t count = 0;
  for (const json& mesh : gltf.value("meshes", json::array())) {
    for (const json& primitive : mesh.at("primitives")) {
      const json& attributes = primitive.at("attributes");
      if (!attributes.contains("POSITION")) continue;
      const json& accessor = primitive.contains("indices") ? primitive.at("indices") : attributes.at("POSITION");
      const json& index_count = gltf.at("accessors").at(accessor.get<std::size_t>()).at("count");
      count += count_primitive_triangles(primitive.value("mode", 4), index_count.get<std::size_t>());
    }
  }
  return count;
}

// Buffers in files of their own must be whole: assimp 5.2 notices, but leaves the file open.
void check_buffer_files(const std::string& path, const json& gltf) {
  for (const json& buffer : gltf.value("buffers", json::array())) {
    const std::string uri = buffer.value("uri", "data:");
    if (uri.starts_with("data:")) continue;
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(std::filesystem::path(path).parent_path() / uri, error);
    if (!error && size < buffer.at("byteLength").get<std::uintmax_t>()) {
      throw std::runtime_error(
          fmt::format("its buffer {} is truncated: {} of {} bytes", uri, size, buffer.at("byteLength").dump()));
    }
  }
}

// assimp 5.2 leaves out the triangles of a glTF 2 file whose index is out of range.
std::optional<std::size_t> check_gltf(const std::string& path, std::string_view text) {
  try {
    const json gltf = json::parse(text);
    if (!gltf.at("asset").at("version").get<std::string>().starts_with("2")) return std::nullopt;
    check_buffer_files(path, gltf);
    return count_gltf_triangles(gltf);
  } catch (const json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 1 ...": the part in brackets helps nobody.
    const std::string_view what = error.what();
    throw std::runtime_error(fmt::format("truncated or malformed glTF: {}", what.substr(what.find(']') + 2)));
  }
}

// A 12-byte header, then chunks of 8 bytes plus content, the first of JSON.
std::optional<std::size_t> check_glb(const std::string& path, std::string_view bytes) {
  if (bytes.size() < 20 || !bytes.starts_with("glTF")) throw std::runtime_error("malformed GLB: there is no header");
  const std::size_t length = read_uint32(bytes, 8);
  if (bytes.size() < length) throw std::runtime_error(fmt::format("truncated: {} of {} bytes", bytes.size(), length));
  const std::size_t json_length = read_uint32(bytes, 12);
  if (json_length > bytes.size() - 20) throw std::runtime_error("malformed GLB: the JSON chunk exceeds the file");
  return check_gltf(path, bytes.substr(20, json_length));
}

}  // namespace

std::optional<std::size_t> check_file(const std::string& path, std::string_view bytes, const std::string& extension) {
  if (extension == "glb") return check_glb(path, bytes);
  if (extension == "gltf") return check_gltf(path, bytes);
  return std::nullopt;
}

}  // namespace lkao::scene
