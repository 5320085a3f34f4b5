// Which triangles continue each other across an edge, in meshes that are not manifold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace lkao::lod {

// Half-edge 3 t + i runs from corner i of triangle t to the next corner.
using HalfEdge = std::uint32_t;
inline constexpr HalfEdge kNoHalfEdge = 0xffffffffu;

inline HalfEdge next_in_triangle(HalfEdge edge) { return edge % 3 == 2 ? edge - 2 : edge + 1; }

struct TrianglePairs {
  std::vector<HalfEdge> partner;        // of every half-edge; kNoHalfEdge where the surface ends there
  std::size_t wrong_winding_count = 0;  // edges of two triangles that wind in opposite senses: no pair
  std::size_t crowded_edge_count = 0;   // edges of more than two triangles
};

// Pairs each half-edge with one that runs the other way between the same vertices. Where more than two triangles meet,
// those that continue each other most smoothly are paired: walls stand on a floor that goes on below them, and the two
// sides of a sheet stay apart. Vertices are joined already; no triangle uses a vertex twice.
TrianglePairs pair_triangles(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles);

}  // namespace lkao::lod
