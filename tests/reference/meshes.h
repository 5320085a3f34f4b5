// Small meshes for the tests of the reference.
#pragma once

#include <cstddef>
#include <cstdint>

#include <random>
#include <vector>

#include <glm/vec3.hpp>

#include "lkao/ambient_occlusion.h"
#include "scene/mesh.h"

namespace lkao::reference {

inline void add_triangle(scene::Mesh& mesh, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {a, b, c});
  mesh.triangles.push_back({first, first + 1, first + 2});
}

// Two triangles: (a, b, c) and (a, c, d).
inline void add_quad(scene::Mesh& mesh, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                     const glm::vec3& d) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {a, b, c, d});
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

// The square |x|, |y| <= half at height z, its front downwards (towards a receiver below).
inline scene::Mesh ceiling(float half, float z) {
  scene::Mesh mesh;
  add_quad(mesh, {-half, -half, z}, {-half, half, z}, {half, half, z}, {half, -half, z});
  return mesh;
}

// The box |x|, |y|, |z| <= half with shared corners, fronts inwards.
inline scene::Mesh closed_box(float half) {
  scene::Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.push_back({(i & 1) != 0 ? half : -half, (i & 2) != 0 ? half : -half, (i & 4) != 0 ? half : -half});
  }
  mesh.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                    {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
  return mesh;
}

// Points evenly in the cube [-1, 1]^3, and unit vectors. The engine alone decides, not the standard library.
class RandomPoints {
 public:
  explicit RandomPoints(unsigned seed) : random_(seed) {}

  float number() { return static_cast<float>(random_() >> 8) * 0x1p-23f - 1; }
  glm::vec3 point() {
    const float x = number(), y = number(), z = number();
    return {x, y, z};
  }

 private:
  std::mt19937 random_;
};

// Triangles of a size, with their centres in the cube [-1, 1]^3.
inline scene::Mesh random_soup(std::size_t triangle_count, float size, unsigned seed) {
  RandomPoints random(seed);
  scene::Mesh mesh;
  for (std::size_t i = 0; i < triangle_count; ++i) {
    const glm::vec3 centre = random.point();
    const glm::vec3 a = centre + size * random.point();
    const glm::vec3 b = centre + size * random.point();
    add_triangle(mesh, a, b, centre + size * random.point());
  }
  return mesh;
}

// Some of their rays are below the geometric horizon, so that any number may be cast.
inline std::vector<Receiver> random_receivers(std::size_t count, unsigned seed) {
  RandomPoints random(seed);
  std::vector<Receiver> receivers(count);
  for (Receiver& receiver : receivers) {
    receiver.position = random.point();
    receiver.normal = random.point();
    receiver.geometric_normal = receiver.normal + 0.5f * random.point();
  }
  return receivers;
}

}  // namespace lkao::reference
