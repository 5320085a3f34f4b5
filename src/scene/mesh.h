// An indexed triangle mesh that owns its arrays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lkao/occluder_bvh.h"

namespace lkao::scene {

struct Holes;

inline constexpr std::uint32_t kNoNormal = 0xffffffffu;
inline constexpr std::uint32_t kNoUv = 0xffffffffu;
inline constexpr std::uint32_t kNoMaterial = 0xffffffffu;
inline constexpr std::uint32_t kNoObject = 0xffffffffu;

struct Mesh {
  std::vector<glm::vec3> positions;  // less the origin
  std::vector<glm::uvec3> triangles;

  // The normals that came with the mesh: unit vectors, and for every triangle which of them its corners have (or
  // kNoNormal). Both empty where there are none.
  std::vector<glm::vec3> normals = {};
  std::vector<glm::uvec3> normal_corners = {};

  // Texture coordinates, where they were asked for: (0, 0) is the upper left corner of the image, (1, 1) the lower
  // right one; and for every triangle which of them its corners have (or kNoUv). Both empty where there are none.
  std::vector<glm::vec2> uvs = {};
  std::vector<glm::uvec3> uv_corners = {};
  // Of each triangle a number in Contents::materials, or kNoMaterial; empty where there are none.
  std::vector<std::uint32_t> materials = {};
  // Of each triangle a number below Contents::object_count, or kNoObject; empty where they were not asked for or the
  // file names none.
  std::vector<std::uint32_t> objects = {};
  // Of all triangles, where holes were asked for and there are some; otherwise null.
  std::shared_ptr<const Holes> holes = {};

  // Far from zero a float is coarse: position + origin is where a vertex lies in its file (choose_origin).
  glm::dvec3 origin{0};

  TriangleMesh view() const { return {positions, triangles}; }
};

// Box around the finite positions that some triangle uses; empty (lower > upper) where there is none.
Bounds bounds_of(const Mesh& mesh);

// Adds the triangles of `part`, which has the same origin, behind those of `mesh`, with their holes. Its materials are
// not among those of the mesh: its triangles have none, and no objects either.
void append(Mesh& mesh, const Mesh& part);

// The triangles of each object as a mesh of its own, with the vertices that they use and their holes alone. `objects`
// must have one of each triangle; those of kNoObject are left out.
std::vector<Mesh> split_by_objects(const Mesh& mesh);

// Turns all triangles round, with their normals: what was inside is outside. Corners keep their texture coordinates.
void turn_round(Mesh& mesh);

// Of all corners of triangles, those for which no normal came with the mesh.
std::size_t count_corners_without_normal(const Mesh& mesh);

// Unit normals, one a vertex, weighted by the angles of the triangles around it; zero where there is no usable
// triangle.
std::vector<glm::vec3> vertex_normals(const Mesh& mesh);

}  // namespace lkao::scene
