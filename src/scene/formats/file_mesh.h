// What a reader finds in a mesh file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "scene/contents.h"
#include "scene/holes.h"

namespace lkao::scene {

// Positions as the file has them, in double and under the numbers of the file, used or not.
struct FileMesh {
  // The fan of a polygon of more than three corners, still to be cut: corner_count - 2 triangles.
  struct Fan {
    std::size_t first_triangle;
    std::size_t corner_count;
  };

  std::vector<glm::dvec3> positions;
  glm::dvec3 origin{0};  // by the file's own word to be added to them
  std::vector<glm::uvec3> triangles;
  // As in Mesh, but of any length: unusable ones may be among them.
  std::vector<glm::vec3> normals;
  std::vector<glm::uvec3> normal_corners;
  // As in Mesh, where they were asked for; those that are not finite may be among them.
  std::vector<glm::vec2> uvs;
  std::vector<glm::uvec3> uv_corners;
  std::vector<std::uint32_t> materials;
  std::vector<std::uint32_t> objects;
  std::shared_ptr<const Holes> holes;
  std::vector<Fan> fans;
  Contents contents;

  // Adds a polygon; nothing where it has fewer than three corners. `corners` are numbers of positions, which may still
  // be unknown; `corner_normals` and `corner_uvs`, as many, numbers of normals or kNoNormal, and of texture coordinates
  // or kNoUv: either every polygon has them or none.
  void add_polygon(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> corner_normals = {},
                   std::span<const std::uint32_t> corner_uvs = {});
};

// Texture coordinates as most formats have them, whose image begins at its lower left corner, as Mesh has them.
inline glm::vec2 from_lower_left(double u, double v) { return {static_cast<float>(u), static_cast<float>(1 - v)}; }

// Puts the triangles of cut polygons in the place of fans; all numbers of positions must be in range.
void cut_polygons(FileMesh& mesh);

}  // namespace lkao::scene
