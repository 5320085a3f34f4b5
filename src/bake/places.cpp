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

// Of both ends of an edge: whether the corners there shade as one surface.
struct SmoothEnds {
  bool from_of_first, to_of_first;

  SmoothEnds(const scene::CornerNormals& normals, const scene::SharedEdge& edge) {
    const scene::EdgeSide &a = edge.sides[0], &b = edge.sides[1];
    const std::array<glm::vec3, 3> of_a = normals.of(a.triangle).corners, of_b = normals.of(b.triangle).corners;
    const bool is_faceted = normals.source() == scene::NormalSource::facet;
    const float least = is_faceted ? static_cast<float>(kSmoothBend) : kSameNormal;
    from_of_first = glm::dot(of_a[a.from], of_b[b.to()]) >= least;
    to_of_first = glm::dot(of_a[a.to()], of_b[b.from]) >= least;
  }
};

// Joins corners around one position, edge by edge.
void join_smooth(const scene::CornerNormals& normals, scene::DisjointSets& sets) {
  for (const scene::SharedEdge& edge : scene::shared_edges(normals.mesh())) {
    const scene::EdgeSide &a = edge.sides[0], &b = edge.sides[1];
    const SmoothEnds is_smooth(normals, edge);
    if (is_smooth.from_of_first) sets.join(number_of(a.triangle, a.from), number_of(b.triangle, b.to()));
    if (is_smooth.to_of_first) sets.join(number_of(a.triangle, a.to()), number_of(b.triangle, b.from));
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

bool shades_as_one(const scene::CornerNormals& normals, const scene::SharedEdge& edge) {
  const SmoothEnds is_smooth(normals, edge);
  return is_smooth.from_of_first && is_smooth.to_of_first;
}

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
