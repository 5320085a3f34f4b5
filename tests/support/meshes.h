// Small meshes for tests.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "lkao/occluder_bvh.h"
#include "lut/random.h"

namespace lkao::tests {

struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  TriangleMesh view() const { return {positions, triangles}; }
};

inline float uniform(lut::RandomStream& random, float low, float high) {
  return low + (high - low) * static_cast<float>(random.next_double());
}

inline glm::vec3 random_point(lut::RandomStream& random, float half_size) {
  const float x = uniform(random, -half_size, half_size), y = uniform(random, -half_size, half_size);
  return {x, y, uniform(random, -half_size, half_size)};
}

// Evenly over the sphere.
inline glm::vec3 random_direction(lut::RandomStream& random) {
  const float z = uniform(random, -1, 1), turn = uniform(random, 0, 2 * std::numbers::pi_v<float>);
  const float radius = std::sqrt(1 - z * z);
  return {radius * std::cos(turn), radius * std::sin(turn), z};
}

inline glm::quat random_rotation(lut::RandomStream& random) {
  const float turn = uniform(random, 0, 2 * std::numbers::pi_v<float>);
  return glm::angleAxis(turn, random_direction(random));
}

// Triangles of one size at random places in [-1, 1]^3.
inline Mesh random_soup(int triangle_count, float triangle_size, std::uint64_t seed) {
  lut::RandomStream random(seed);
  Mesh mesh;
  for (int i = 0; i < triangle_count; ++i) {
    const glm::vec3 center = random_point(random, 1.0f);
    for (int k = 0; k < 3; ++k) mesh.positions.push_back(center + random_point(random, triangle_size));
    const auto first = static_cast<unsigned>(3 * i);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  return mesh;
}

// Two triangles over the parallelogram corner, corner + u, corner + u + v, corner + v; fronts towards u x v.
inline void add_quad(Mesh& mesh, const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
  const auto first = static_cast<unsigned>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {corner, corner + u, corner + u + v, corner + v});
  mesh.triangles.emplace_back(first, first + 1, first + 2);
  mesh.triangles.emplace_back(first, first + 2, first + 3);
}

// The box [-1, 1]^3 of 8 shared corners, fronts outwards.
inline Mesh closed_box() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

// The unit sphere of shared vertices, with fans of slivers at the poles; fronts outwards.
inline Mesh closed_sphere(int slices, int stacks) {
  Mesh mesh;
  mesh.positions.emplace_back(0, 1, 0);
  for (int i = 1; i < stacks; ++i) {
    const double polar = std::numbers::pi * i / stacks;
    for (int j = 0; j < slices; ++j) {
      const double turn = 2 * std::numbers::pi * j / slices;
      mesh.positions.emplace_back(std::sin(polar) * std::cos(turn), std::cos(polar), -std::sin(polar) * std::sin(turn));
    }
  }
  mesh.positions.emplace_back(0, -1, 0);
  const auto vertex = [&](int stack, int slice) {
    return static_cast<unsigned>(1 + (stack - 1) * slices + slice % slices);
  };
  const auto last = static_cast<unsigned>(mesh.positions.size() - 1);
  for (int j = 0; j < slices; ++j) {
    mesh.triangles.emplace_back(0, vertex(1, j), vertex(1, j + 1));
    for (int i = 1; i + 1 < stacks; ++i) {
      mesh.triangles.emplace_back(vertex(i, j), vertex(i + 1, j), vertex(i, j + 1));
      mesh.triangles.emplace_back(vertex(i, j + 1), vertex(i + 1, j), vertex(i + 1, j + 1));
    }
    mesh.triangles.emplace_back(vertex(stacks - 1, j), last, vertex(stacks - 1, j + 1));
  }
  return mesh;
}

}  // namespace lkao::tests
