#include "scene/corner_normals.h"

#include <algorithm>
#include <cstdint>

#include <glm/geometric.hpp>

#include "scene/disjoint_sets.h"
#include "scene/facet.h"
#include "scene/shared_edges.h"

namespace lkao::scene {

namespace {

// Cosine of the bend beyond which a surface does not go on over an edge, but lies on its own back.
constexpr double kFoldedBack = -0.9999;

std::uint32_t corner_number(std::uint32_t triangle, std::uint32_t corner) { return 3 * triangle + corner; }

// Corners that are joined through edges around one position, but not over a fold.
DisjointSets smooth_sets(const Mesh& mesh) {
  DisjointSets sets(3 * mesh.triangles.size());
  for (const SharedEdge& edge : shared_edges(mesh)) {
    const auto& [a, b] = edge.sides;
    const Facet of_a(mesh, mesh.triangles[a.triangle]), of_b(mesh, mesh.triangles[b.triangle]);
    if (glm::dot(of_a.normal(), of_b.normal()) < kFoldedBack) continue;
    sets.join(corner_number(a.triangle, a.from), corner_number(b.triangle, b.to()));
    sets.join(corner_number(a.triangle, a.to()), corner_number(b.triangle, b.from));
  }
  return sets;
}

bool has_bare_corner(const Mesh& mesh) {
  return mesh.normal_corners.empty() ||
         std::any_of(mesh.normal_corners.begin(), mesh.normal_corners.end(), [](const glm::uvec3& corners) {
           return corners.x == kNoNormal || corners.y == kNoNormal || corners.z == kNoNormal;
         });
}

}  // namespace

NormalSource usual_normals(const Mesh& mesh) { return mesh.normals.empty() ? NormalSource::facet : NormalSource::file; }

CornerNormals::CornerNormals(const Mesh& mesh, NormalSource source) : mesh_(mesh), source_(source) {
  const bool needs_smooth = source == NormalSource::smooth || (source == NormalSource::file && has_bare_corner(mesh));
  if (!needs_smooth) return;
  DisjointSets sets = smooth_sets(mesh);
  std::vector<std::uint32_t> numbers(3 * mesh.triangles.size(), 0);  // of the sets, at their least corners
  std::vector<glm::dvec3> sums;
  smooth_corners_.resize(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Facet facet(mesh, mesh.triangles[t]);
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t corner = corner_number(t, static_cast<std::uint32_t>(i)), least = sets.find(corner);
      if (least == corner) {
        numbers[corner] = static_cast<std::uint32_t>(sums.size());
        sums.emplace_back(0.0);
      }
      smooth_corners_[t][i] = numbers[least];
      if (facet.is_usable()) sums[numbers[least]] += facet.angle(i) * facet.normal();
    }
  }
  smooth_.reserve(sums.size());
  for (const glm::dvec3& sum : sums) {
    const double length = glm::length(sum);
    // What cancels to rounding points nowhere in particular.
    smooth_.push_back(length > 1e-12 ? glm::vec3(sum / length) : glm::vec3(0.0f));
  }
}

TriangleNormals CornerNormals::of(std::size_t triangle) const {
  TriangleNormals normals{.facet = Facet(mesh_, mesh_.triangles[triangle]).normal(), .corners = {}};
  normals.corners.fill(glm::vec3(normals.facet));
  if (source_ == NormalSource::facet) return normals;
  for (int i = 0; i < 3; ++i) {
    const bool of_file = source_ == NormalSource::file && !mesh_.normal_corners.empty() &&
                         mesh_.normal_corners[triangle][i] != kNoNormal;
    normals.corners[static_cast<std::size_t>(i)] =
        of_file ? mesh_.normals[mesh_.normal_corners[triangle][i]] : smooth_[smooth_corners_[triangle][i]];
  }
  const auto& [a, b, c] = normals.corners;
  const glm::dvec3 sum = glm::dvec3(a) + glm::dvec3(b) + glm::dvec3(c);
  if (source_ == NormalSource::file && glm::dot(sum, normals.facet) < 0) normals.facet = -normals.facet;
  for (glm::vec3& normal : normals.corners) {
    if (!(glm::dot(glm::dvec3(normal), normals.facet) > 0)) normal = glm::vec3(normals.facet);
  }
  return normals;
}

}  // namespace lkao::scene
