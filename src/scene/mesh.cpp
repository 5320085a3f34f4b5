#include "scene/mesh.h"

#include <limits>
#include <stdexcept>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lut/coordinates.h"
#include "scene/facet.h"
#include "scene/holes.h"

namespace lkao::scene {

namespace {

// Values of corners, and which of them the corners of each triangle have. Where only one of two meshes has such values,
// the corners of the other have none. The triangles are already joined.
template <typename Value>
void append_corners(std::vector<Value>& values, std::vector<glm::uvec3>& corners, std::size_t triangle_count,
                    const std::vector<Value>& part_values, const std::vector<glm::uvec3>& part_corners,
                    std::size_t part_triangle_count, std::uint32_t none) {
  if (values.empty() && part_values.empty()) return;
  const auto first = static_cast<std::uint32_t>(values.size());
  values.insert(values.end(), part_values.begin(), part_values.end());
  corners.reserve(triangle_count);
  corners.resize(triangle_count - part_triangle_count, glm::uvec3(none));
  for (glm::uvec3 numbers : part_corners) {
    for (int i = 0; i < 3; ++i) numbers[i] += numbers[i] == none ? 0 : first;
    corners.push_back(numbers);
  }
  corners.resize(triangle_count, glm::uvec3(none));
}

// The triangles are already joined.
void append_holes(Mesh& mesh, const Mesh& part) {
  if (!mesh.holes && !part.holes) return;
  Holes joined = mesh.holes ? *mesh.holes : Holes{};
  joined.numbers.resize(mesh.triangles.size() - part.triangles.size(), kWhole);
  if (part.holes) joined.append(*part.holes);
  joined.numbers.resize(mesh.triangles.size(), kWhole);
  mesh.holes = std::make_shared<const Holes>(std::move(joined));
}

constexpr std::uint32_t kNoVertex = 0xffffffffu;

// Some triangles, with the vertices that they use and their holes. `new_numbers`, of all vertices, is kNoVertex before
// and after.
Mesh part_of(const Mesh& mesh, const std::vector<std::uint32_t>& triangles, std::vector<std::uint32_t>& new_numbers) {
  Mesh part;
  part.origin = mesh.origin;
  part.triangles.reserve(triangles.size());
  Holes holes = mesh.holes ? Holes{.materials = mesh.holes->materials, .triangles = {}, .numbers = {}} : Holes{};
  for (const std::uint32_t t : triangles) {
    glm::uvec3 corners = mesh.triangles[t];
    for (int i = 0; i < 3; ++i) {
      std::uint32_t& number = new_numbers[corners[i]];
      if (number == kNoVertex) {
        number = static_cast<std::uint32_t>(part.positions.size());
        part.positions.push_back(mesh.positions[corners[i]]);
      }
      corners[i] = number;
    }
    part.triangles.push_back(corners);
    if (mesh.holes) holes.add(*mesh.holes, t);
  }
  for (const std::uint32_t t : triangles) {
    for (int i = 0; i < 3; ++i) new_numbers[mesh.triangles[t][i]] = kNoVertex;
  }
  if (!holes.triangles.empty()) part.holes = std::make_shared<const Holes>(std::move(holes));
  return part;
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
  const std::size_t count = mesh.triangles.size(), part_count = part.triangles.size();
  append_corners(mesh.normals, mesh.normal_corners, count, part.normals, part.normal_corners, part_count, kNoNormal);
  append_corners(mesh.uvs, mesh.uv_corners, count, part.uvs, part.uv_corners, part_count, kNoUv);
  if (!mesh.materials.empty()) mesh.materials.resize(count, kNoMaterial);
  if (!mesh.objects.empty()) mesh.objects.resize(count, kNoObject);
  append_holes(mesh, part);
}

std::vector<Mesh> split_by_objects(const Mesh& mesh) {
  std::vector<std::vector<std::uint32_t>> triangles;
  for (std::uint32_t t = 0; t < mesh.objects.size(); ++t) {
    const std::uint32_t object = mesh.objects[t];
    if (object == kNoObject) continue;
    if (object >= triangles.size()) triangles.resize(object + std::size_t{1});
    triangles[object].push_back(t);
  }
  std::vector<Mesh> objects;
  objects.reserve(triangles.size());
  std::vector<std::uint32_t> new_numbers(mesh.positions.size(), kNoVertex);
  for (const std::vector<std::uint32_t>& of_object : triangles) {
    objects.push_back(part_of(mesh, of_object, new_numbers));
  }
  return objects;
}

void turn_round(Mesh& mesh) {
  for (glm::uvec3& triangle : mesh.triangles) std::swap(triangle.y, triangle.z);
  for (glm::uvec3& corners : mesh.normal_corners) std::swap(corners.y, corners.z);
  for (glm::uvec3& corners : mesh.uv_corners) std::swap(corners.y, corners.z);
  for (glm::vec3& normal : mesh.normals) normal = -normal;
  if (!mesh.holes) return;
  auto turned = std::make_shared<Holes>(*mesh.holes);
  for (HoleTriangle& triangle : turned->triangles) triangle.turn_round();
  mesh.holes = std::move(turned);
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
