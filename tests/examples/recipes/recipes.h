// Ambient occlusion as three programs have it, by lkao. README.md says what is alike.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace lkao::recipes {

// As libigl's ambient_occlusion(V, F, P, N, n): the share of the hemisphere above each point that the mesh blocks, at
// any distance; 1 is all of it. Arrays row by row, three numbers a row: vertices, triangles, points, normals.
std::vector<double> libigl_like(std::span<const double> V, std::span<const int> F, std::span<const double> P,
                                std::span<const double> N, int n);

// As aobaker bakes it: how bright each vertex is, 1 where it sees nothing of the mesh. Three floats a vertex.
std::vector<float> aobaker_like(std::span<const float> positions, std::span<const float> normals,
                                std::span<const std::uint32_t> indices, int nsamples);

// A point that a pixel shows, and the normal there.
struct Hit {
  glm::vec3 position{0};
  glm::vec3 normal{0};
};

// As hdEmbree shades a pixel: cosine-weighted visibility, which each pass samples anew; the mean over passes converges.
std::vector<float> hdembree_like(std::span<const glm::vec3> points, std::span<const glm::uvec3> triangles,
                                 std::span<const Hit> pixels, int pass, int samples = 16);

}  // namespace lkao::recipes
