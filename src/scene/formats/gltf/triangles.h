// Triangles of a primitive's indices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace lkao::scene::gltf {

enum class Mode { triangles = 4, triangle_strip = 5, triangle_fan = 6 };

// All in the primitive's direction: in a strip every second triangle is turned round. Throws std::runtime_error naming
// `place` where a list is no multiple of three long, or an index is not below vertex_count.
std::vector<glm::uvec3> make_triangles(Mode mode, std::span<const std::uint32_t> indices, std::size_t vertex_count,
                                       const std::string& place);

}  // namespace lkao::scene::gltf
