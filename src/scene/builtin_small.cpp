// The small built-in scenes; builtin.h states their answers.
#include <cmath>

#include <glm/geometric.hpp>

#include "scene/builtin.h"
#include "scene/shapes.h"

namespace lkao::scene {

namespace {

constexpr double kPi = 3.141592653589793;

// A square floor y = 0, front up.
void add_floor(Mesh& mesh, double half_side) {
  add_quad(mesh, {-half_side, 0, half_side}, {half_side, 0, half_side}, {half_side, 0, -half_side},
           {-half_side, 0, -half_side});
}

// Radius of the regular polygon with the area of the unit circle.
double equal_area_radius(int side_count) {
  const glm::dvec2 step = unit_circle(1.0 / side_count);
  return std::sqrt(2 * kPi / (side_count * step.y));
}

}  // namespace

Mesh make_plane() {
  Mesh mesh;
  add_floor(mesh, 100);
  return mesh;
}

Mesh make_box() {
  Mesh mesh;
  add_box(mesh, {-1, 0, -1}, {1, 2, 1});
  for (glm::uvec3& triangle : mesh.triangles) std::swap(triangle.y, triangle.z);  // fronts inwards
  return mesh;
}

Mesh make_wall() {
  Mesh mesh;
  add_floor(mesh, 100);
  add_quad(mesh, {-100, 0, 0}, {100, 0, 0}, {100, 100, 0}, {-100, 100, 0});
  return mesh;
}

Mesh make_disk() {
  constexpr int kDiskSideCount = 512;
  Mesh mesh;
  add_floor(mesh, 10);
  const auto center = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.emplace_back(0, 1, 0);
  for (int i = 0; i < kDiskSideCount; ++i) {
    const glm::dvec2 p = equal_area_radius(kDiskSideCount) * unit_circle(static_cast<double>(i) / kDiskSideCount);
    mesh.positions.emplace_back(glm::dvec3(p.x, 1, p.y));
  }
  // Front down, towards the floor.
  for (std::uint32_t i = 0; i < kDiskSideCount; ++i) {
    mesh.triangles.emplace_back(center, center + 1 + i, center + 1 + (i + 1) % kDiskSideCount);
  }
  return mesh;
}

Mesh make_sphere() {
  constexpr int kSphereSegmentCount = 256;
  Mesh mesh;
  add_floor(mesh, 10);
  add_sphere(mesh, {0, 2, 0}, equal_area_radius(kSphereSegmentCount), kSphereSegmentCount, kSphereSegmentCount / 2);
  return mesh;
}

}  // namespace lkao::scene
