// Where the surface of a mesh goes on from one triangle to another.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scene/mesh.h"

namespace lkao::scene {

// One side of an edge: of a triangle, from corner `from` to corner `to()`.
struct EdgeSide {
  std::uint32_t triangle;
  std::uint32_t from;

  std::uint32_t to() const { return (from + 1) % 3; }
  std::uint32_t opposite() const { return (from + 2) % 3; }
};

// The two sides run against each other: the corner `from` of one lies where the corner `to()` of the other does.
struct SharedEdge {
  std::array<EdgeSide, 2> sides;
};

// By positions, not by numbers of vertices: a seam, along which a file has its vertices twice, is no end of the
// surface. Unusable triangles have no edges. Where a knot of very many triangles shares an edge, not every pair is
// named.
std::vector<SharedEdge> shared_edges(const Mesh& mesh);

}  // namespace lkao::scene
