#include "bake/tangent_frames.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "bake/places.h"
#include "scene/disjoint_sets.h"
#include "scene/facet.h"
#include "scene/shared_edges.h"

namespace lkao::bake {
namespace {

std::uint32_t number_of_corner(std::uint32_t triangle, std::uint32_t corner) { return 3 * triangle + corner; }

// Corners that have one tangent.
scene::DisjointSets tangent_sets(const TextureLayout& layout) {
  scene::DisjointSets sets(3 * layout.mesh().triangles.size());
  for (const scene::SharedEdge& edge : scene::shared_edges(layout.mesh())) {
    const auto& [a, b] = edge.sides;
    if (!layout.has(a.triangle) || !layout.has(b.triangle)) continue;
    if (layout.is_mirrored(a.triangle) != layout.is_mirrored(b.triangle)) continue;
    if (!layout.has_same_uvs(edge) || !shades_as_one(layout.normals(), edge)) continue;
    sets.join(number_of_corner(a.triangle, a.from), number_of_corner(b.triangle, b.to()));
    sets.join(number_of_corner(a.triangle, a.to()), number_of_corner(b.triangle, b.from));
  }
  return sets;
}

// Where u grows on a triangle; of any length.
glm::dvec3 along_u(const TextureLayout& layout, std::uint32_t triangle) {
  const scene::Facet facet(layout.mesh(), layout.mesh().triangles[triangle]);
  const glm::dvec3 to_b = glm::dvec3(facet.b) - glm::dvec3(facet.a), to_c = glm::dvec3(facet.c) - glm::dvec3(facet.a);
  const glm::dvec2 a = layout.uv(triangle, 0);
  const glm::dvec2 uv_b = layout.uv(triangle, 1) - a, uv_c = layout.uv(triangle, 2) - a;
  const double turn = uv_b.x * uv_c.y - uv_b.y * uv_c.x;
  return (to_b * uv_c.y - to_c * uv_b.y) * (turn < 0 ? -1.0 : 1.0);
}

// The part of a direction that is orthogonal to a unit normal, as a unit vector; where there is none, any.
glm::dvec3 orthogonal_to(const glm::dvec3& normal, const glm::dvec3& direction) {
  const glm::dvec3 part = direction - glm::dot(direction, normal) * normal;
  const double length = glm::length(part);
  if (length > 1e-9 * glm::length(direction)) return part / length;
  const glm::dvec3 axis = std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::normalize(glm::cross(normal, axis));
}

}  // namespace

TangentFrames::TangentFrames(const TextureLayout& layout) : layout_(layout) {
  const auto triangle_count = static_cast<std::uint32_t>(layout.mesh().triangles.size());
  scene::DisjointSets sets = tangent_sets(layout);
  std::vector<glm::dvec3> sums(std::size_t{3} * triangle_count, glm::dvec3(0.0));  // at the sets' least corners
  for (std::uint32_t t = 0; t < triangle_count; ++t) {
    if (!layout.has(t)) continue;
    const scene::Facet facet(layout.mesh(), layout.mesh().triangles[t]);
    const scene::TriangleNormals normals = layout.normals().of(t);
    const glm::dvec3 direction = along_u(layout, t);
    for (std::uint32_t i = 0; i < 3; ++i) {
      sums[sets.find(number_of_corner(t, i))] +=
          facet.angle(static_cast<int>(i)) * orthogonal_to(glm::dvec3(normals.corners[i]), direction);
    }
  }
  tangents_.resize(triangle_count);
  for (std::uint32_t t = 0; t < triangle_count; ++t) {
    if (!layout.has(t)) continue;
    const scene::TriangleNormals normals = layout.normals().of(t);
    for (std::uint32_t i = 0; i < 3; ++i) {
      tangents_[t][i] =
          glm::vec3(orthogonal_to(glm::dvec3(normals.corners[i]), sums[sets.find(number_of_corner(t, i))]));
    }
  }
}

glm::mat3 TangentFrames::at(std::uint32_t triangle, const glm::dvec3& w) const {
  const auto mix = [&w](const std::array<glm::vec3, 3>& v) {
    return w.x * glm::dvec3(v[0]) + w.y * glm::dvec3(v[1]) + w.z * glm::dvec3(v[2]);
  };
  const glm::dvec3 normal = glm::normalize(mix(layout_.normals().of(triangle).corners));
  const glm::dvec3 tangent = orthogonal_to(normal, mix(tangents_[triangle]));
  const double side = layout_.is_mirrored(triangle) ? -1 : 1;
  return {glm::vec3(tangent), glm::vec3(side * glm::cross(normal, tangent)), glm::vec3(normal)};
}

}  // namespace lkao::bake
