#include "bake/places.h"

#include <limits>

#include <glm/geometric.hpp>

#include "scene/disjoint_sets.h"
#include "scene/facet.h"
#include "scene/shared_edges.h"

namespace lkao::bake {
namespace {

// Cosine of 1 degree: normals of one vertex that a file stores twice, rounded to bytes perhaps, are the same normal.
constexpr float kSameNormal = 0.99985f;

std::uint32_t number_of(std::uint32_t triangle, std::uint32_t corner) { return 3 * triangle + corner; }

// Joins corners around one position, edge by edge.
void join_smooth(const scene::CornerNormals& normals, scene::DisjointSets& sets) {
  const bool is_faceted = normals.source() == scene::NormalSource::facet;
  for (const scene::SharedEdge& edge : scene::shared_edges(normals.mesh())) {
    const scene::EdgeSide &a = edge.sides[0], &b = edge.sides[1];
    const std::array<glm::vec3, 3> of_a = normals.of(a.triangle).corners, of_b = normals.of(b.triangle).corners;
    const float least = is_faceted ? static_cast<float>(kSmoothBend) : kSameNormal;
    const auto join_if_same = [&](std::uint32_t corner_a, std::uint32_t corner_b) {
      if (glm::dot(of_a[corner_a], of_b[corner_b]) < least) return;
      sets.join(number_of(a.triangle, corner_a), number_of(b.triangle, corner_b));
    };
    join_if_same(a.from, b.to());
    join_if_same(a.to(), b.from);
  }
}

// Joins all corners of each vertex.
void join_vertices(const scene::Mesh& mesh, scene::DisjointSets& sets) {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> firsts(mesh.positions.size(), kNone);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      std::uint32_t& first = firsts[mesh.triangles[t][static_cast<int>(i)]];
      if (first == kNone) first = number_of(t, i);
      sets.join(first, number_of(t, i));
    }
  }
}

}  // namespace

Places make_places(const scene::CornerNormals& normals, Per per) {
  const scene::Mesh& mesh = normals.mesh();
  scene::DisjointSets sets(3 * mesh.triangles.size());
  join_smooth(normals, sets);
  if (per == Per::vertex) join_vertices(mesh, sets);

  Places places;
  places.of_corner.resize(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t corner = number_of(t, i), least = sets.find(corner);
      places.of_corner[t][static_cast<int>(i)] = least == corner
                                                     ? static_cast<std::uint32_t>(places.count++)
                                                     : places.of_corner[least / 3][static_cast<int>(least % 3)];
    }
  }
  return places;
}

}  // namespace lkao::bake
