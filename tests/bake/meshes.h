// Small meshes of baking tests, and what they bake to.
#pragma once

#include <initializer_list>
#include <span>
#include <vector>

#include "bake/corner_receivers.h"
#include "bake/places.h"
#include "bake/split_vertices.h"
#include "lkao/lkao.h"
#include "scene/mesh.h"

namespace lkao::bake {

using scene::CornerNormals, scene::Mesh, scene::NormalSource;

// Two triangles on corners of their own, counter-clockwise seen from the front.
inline void add_quad(Mesh& mesh, const std::initializer_list<glm::vec3>& corners) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), corners);
  mesh.triangles.emplace_back(first, first + 1, first + 2);
  mesh.triangles.emplace_back(first, first + 2, first + 3);
}

// A box seen from within. Its faces have corners of their own.
inline Mesh split_room(const glm::vec3& size = {3, 2, 5}) {
  const float x = size.x, y = size.y, z = size.z;
  Mesh mesh;
  add_quad(mesh, {{0, 0, 0}, {0, 0, z}, {x, 0, z}, {x, 0, 0}});
  add_quad(mesh, {{0, y, 0}, {x, y, 0}, {x, y, z}, {0, y, z}});
  add_quad(mesh, {{0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}});
  add_quad(mesh, {{0, 0, z}, {0, y, z}, {x, y, z}, {x, 0, z}});
  add_quad(mesh, {{0, 0, 0}, {0, y, 0}, {0, y, z}, {0, 0, z}});
  add_quad(mesh, {{x, 0, 0}, {x, 0, z}, {x, y, z}, {x, y, 0}});
  return mesh;
}

// The same surface, one vertex a position.
inline Mesh joined(const Mesh& mesh) {
  Mesh result;
  std::vector<std::uint32_t> numbers;
  for (const glm::vec3& p : mesh.positions) {
    std::uint32_t number = 0;
    while (number < result.positions.size() && result.positions[number] != p) ++number;
    if (number == result.positions.size()) result.positions.push_back(p);
    numbers.push_back(number);
  }
  for (const glm::uvec3& t : mesh.triangles) result.triangles.emplace_back(numbers[t.x], numbers[t.y], numbers[t.z]);
  return result;
}

// With the front behind.
inline Mesh turned(Mesh mesh) {
  for (glm::uvec3& t : mesh.triangles) t = {t.x, t.z, t.y};
  return mesh;
}

inline std::vector<float> ask(const Mesh& mesh, std::span<const Receiver> receivers, float radius) {
  const AmbientOcclusion ao(OccluderBvh(mesh.view()), SamplePattern::standard(256), {.radius = radius});
  std::vector<float> occlusion(receivers.size());
  ao.query(receivers, {.occlusion = occlusion});
  return occlusion;
}

// Of vertices; `mesh` is split where corners differ.
inline std::vector<float> bake_corners(Mesh& mesh, NormalSource source, Per per = Per::vertex, float radius = 1000) {
  const Bounds bounds = scene::bounds_of(mesh);
  const CornerNormals normals(mesh, source);
  const Places places = make_places(normals, per);
  const std::vector<float> occlusion = ask(mesh, corner_receivers(normals, bounds), radius);
  return split_vertices(mesh, places, average_at_places(mesh, places, occlusion, bounds));
}

}  // namespace lkao::bake
