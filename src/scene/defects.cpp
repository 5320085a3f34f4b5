#include "scene/defects.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <unordered_set>
#include <utility>
#include <vector>

#include "bvh/usable_triangle.h"
#include "lut/coordinates.h"
#include "scene/facet.h"
#include "scene/holes.h"

namespace lkao::scene {

namespace {

// The nine coordinates of a triangle as bits, corners in ascending order: equal for equal triangles.
using TriangleKey = std::array<std::uint32_t, 9>;

struct TriangleKeyHash {
  std::size_t operator()(const TriangleKey& key) const {
    std::uint64_t hash = 0;
    for (std::uint32_t word : key) hash = (std::rotl(hash, 29) ^ word) * 0x9e3779b97f4a7c15u;
    return static_cast<std::size_t>(hash ^ (hash >> 32));
  }
};

TriangleKey key_of(const glm::vec3 (&corners)[3]) {
  std::array<std::array<std::uint32_t, 3>, 3> bits;
  for (std::size_t i = 0; i < 3; ++i) {
    // Adding +0 turns -0 into +0: the two are one position.
    for (int axis = 0; axis < 3; ++axis) {
      bits[i][static_cast<std::size_t>(axis)] = std::bit_cast<std::uint32_t>(corners[i][axis] + 0.0f);
    }
  }
  std::sort(bits.begin(), bits.end());
  return {bits[0][0], bits[0][1], bits[0][2], bits[1][0], bits[1][1], bits[1][2], bits[2][0], bits[2][1], bits[2][2]};
}

void corners_of(const Mesh& mesh, const glm::uvec3& triangle, glm::vec3 (&corners)[3]) {
  for (int i = 0; i < 3; ++i) corners[i] = mesh.positions[triangle[i]];
}

// Of a list that has one entry for every triangle, or none.
template <typename Entry>
void keep(const std::vector<bool>& usable, std::vector<Entry>& of_triangles) {
  if (of_triangles.empty()) return;
  std::size_t kept = 0;
  for (std::size_t t = 0; t < usable.size(); ++t) {
    if (usable[t]) of_triangles[kept++] = of_triangles[t];
  }
  of_triangles.resize(kept);
}

}  // namespace

Defects find_defects(const Mesh& mesh) {
  Defects defects;
  std::vector<bool> used(mesh.positions.size(), false);
  std::unordered_set<TriangleKey, TriangleKeyHash> seen;
  seen.reserve(mesh.triangles.size());
  for (const glm::uvec3& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) used[triangle[i]] = true;
    glm::vec3 corners[3];
    corners_of(mesh, triangle, corners);
    if (!lut::is_in_range(corners[0], corners[1], corners[2])) {
      ++defects.non_finite_count;
    } else if (bvh::has_zero_area(corners[0], corners[1], corners[2])) {
      ++defects.zero_area_count;
    } else if (!seen.insert(key_of(corners)).second) {
      ++defects.duplicate_count;
    }
  }
  defects.unused_vertex_count = static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
  return defects;
}

void drop_bad_triangles(Mesh& mesh) {
  std::vector<bool> usable;
  usable.reserve(mesh.triangles.size());
  for (const glm::uvec3& triangle : mesh.triangles) usable.push_back(Facet(mesh, triangle).is_usable());
  if (std::find(usable.begin(), usable.end(), false) == usable.end()) return;
  keep(usable, mesh.triangles);
  keep(usable, mesh.normal_corners);
  keep(usable, mesh.uv_corners);
  keep(usable, mesh.materials);
  keep(usable, mesh.objects);
  if (!mesh.holes) return;
  auto holes = std::make_shared<Holes>(*mesh.holes);
  keep(usable, holes->numbers);
  mesh.holes = std::move(holes);
}

}  // namespace lkao::scene
