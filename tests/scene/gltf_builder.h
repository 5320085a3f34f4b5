// Small glTF files, made in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

namespace lkao::scene {

// Component types of accessors.
inline constexpr int kInt8 = 5120, kUint8 = 5121, kInt16 = 5122, kUint16 = 5123, kUint32 = 5125, kFloat = 5126;

struct GltfBuilder {
  nlohmann::json document;
  std::string buffer;  // buffers[0]

  // Adds bytes to the buffer, and a view of them; returns its number.
  std::size_t add_view(const std::string& bytes, std::size_t stride = 0);
  std::size_t add_accessor(std::size_t view, int component_type, std::size_t count, const char* shape);
  // Adds values of `width` components each, and a view and an accessor of them; returns the accessor's number.
  template <typename Number>
  std::size_t add_values(const std::vector<Number>& numbers, int component_type, const char* shape, std::size_t width);

  nlohmann::json& primitive() { return document["meshes"][0]["primitives"][0]; }
  nlohmann::json& node(std::size_t i) { return document["nodes"][i]; }

  // The text with the buffer in it; as GLB.
  std::string gltf() const;
  std::string glb() const;
};

// Node 0 shows mesh 0 of one primitive: accessor 0 has its 8 positions, accessor 1 its 36 indices. The cube from
// (0, 0, 0) to (1, 1, 1), fronts outside.
GltfBuilder gltf_cube();
const std::vector<glm::vec3>& cube_corners();
const std::vector<std::uint16_t>& cube_indices();

// The square (0,0,0), (1,0,0), (1,1,0), (0,1,0), likewise.
GltfBuilder gltf_square(const std::vector<std::uint16_t>& indices, int mode = 4);

// Of it, masked where this image (a PNG, says the file) has no alpha; each texel shows whole. Set 0 is x and 1 - y.
GltfBuilder gltf_leaf(const std::string& image);

// The bytes of a list as they lie in memory.
template <typename T>
std::string bytes_of(const std::vector<T>& list) {
  std::string bytes(list.size() * sizeof(T), '\0');
  if (!list.empty()) std::memcpy(bytes.data(), list.data(), bytes.size());
  return bytes;
}

// A GLB of these chunks ("JSON" + content ...), each with the header that belongs to it, without padding.
struct Chunk {
  std::string type;
  std::string content;
};
std::string glb_of(const std::vector<Chunk>& chunks);

std::string to_base64(const std::string& bytes);

template <typename Number>
std::size_t GltfBuilder::add_values(const std::vector<Number>& numbers, int component_type, const char* shape,
                                    std::size_t width) {
  return add_accessor(add_view(bytes_of(numbers)), component_type, numbers.size() / width, shape);
}

}  // namespace lkao::scene
