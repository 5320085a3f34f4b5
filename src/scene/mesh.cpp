#include "scene/mesh.h"

#include <limits>
#include <stdexcept>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lut/coordinates.h"
#include "scene/facet.h"

namespace lkao::scene {

namespace {

// Where only one of the meshes has normals, the corners of the other have none. The triangles are already joined.
void append_normals(Mesh& mesh, const Mesh& part) {
  if (mesh.normals.empty() && part.normals.empty()) return;
  const auto first = static_cast<std::uint32_t>(mesh.normals.size());
  mesh.normals.insert(mesh.normals.end(), part.normals.begin(), part.normals.end());
  mesh.normal_corners.resize(mesh.triangles.size() - part.triangles.size(), glm::uvec3(kNoNormal));
  for (glm::uvec3 corners : part.normal_corners) {
    for (int i = 0; i < 3; ++i) corners[i] += corners[i] == kNoNormal ? 0 : first;
    mesh.normal_corners.push_back(corners);
  }
  mesh.normal_corners.resize(mesh.triangles.size(), glm::uvec3(kNoNormal));
}

}  // namespace

Bounds bounds_of(const Mesh& mesh) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Bounds bounds{glm::vec3(kInfinity), glm::vec3(-kInfinity)};
  for (const glm::uvec3& triangle : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      const glm::vec3& p = mesh.positions[triangle[corner]];
      if (!lut::is_in_range(p)) continue;
      bounds.lower = glm::min(bounds.lower, p);
      bounds.upper = glm::max(bounds.upper, p);
    }
  }
  return bounds;
}

void append(Mesh& mesh, const Mesh& part) {
  const std::size_t first = mesh.positions.size();
  if (first + part.positions.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw std::length_error("append: a mesh cannot have more than 2^32 - 1 vertices");
  }
  mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
  mesh.triangles.reserve(mesh.triangles.size() + part.triangles.size());
  for (const glm::uvec3& triangle : part.triangles) {
    mesh.triangles.push_back(triangle + static_cast<std::uint32_t>(first));
  }
  append_normals(mesh, part);
}

void turn_round(Mesh& mesh) {
  for (glm::uvec3& triangle : mesh.triangles) std::swap(triangle.y, triangle.z);
  for (glm::uvec3& corners : mesh.normal_corners) std::swap(corners.y, corners.z);
  for (glm::vec3& normal : mesh.normals) normal = -normal;
}

std::size_t count_corners_without_normal(const Mesh& mesh) {
  if (mesh.normal_corners.empty()) return 3 * mesh.triangles.size();
  std::size_t count = 0;
  for (const glm::uvec3& corners : mesh.normal_corners) {
    for (int i = 0; i < 3; ++i) count += corners[i] == kNoNormal ? 1 : 0;
  }
  return count;
}

std::vector<glm::vec3> vertex_normals(const Mesh& mesh) {
  // One pass in triangle order: sums of doubles come out the same on every run.
  std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
  for (const glm::uvec3& triangle : mesh.triangles) {
    const Facet facet(mesh, triangle);
    if (!facet.is_usable()) continue;
    const glm::dvec3 normal = facet.normal();
    for (int i = 0; i < 3; ++i) sums[triangle[i]] += normal * facet.angle(i);
  }

  std::vector<glm::vec3> normals(sums.size(), glm::vec3(0.0f));
  for (std::size_t i = 0; i < sums.size(); ++i) {
    // Opposite faces cancel to rounding; what is left points nowhere in particular.
    const double length = glm::length(sums[i]);
    if (length > 1e-12) normals[i] = glm::vec3(sums[i] / length);
  }
  return normals;
}

}  // namespace lkao::scene
