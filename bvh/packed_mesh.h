// The mesh of a hierarchy, which builder and queries read: a copy, or the host's own arrays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "bvh/usable_triangle.h"
#include "lkao/occluder_bvh.h"

namespace lkao::bvh {

// Every index is a position's.
struct PackedMesh {
  // The copy; empty where the host's arrays are read.
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  glm::dvec3 origin{0};  // of the positions
  std::optional<TriangleMesh> host = std::nullopt;

  IndexView triangle_view() const { return host ? host->triangles : IndexView(triangles); }
  std::size_t position_count() const { return host ? host->positions.size() : positions.size(); }

  // Corner 0, 1 or 2 of a triangle.
  glm::vec3 corner(std::uint32_t primitive, int which) const {
    return host ? host_corner(primitive, which) : positions[triangles[primitive][which]];
  }
  Corners corners(std::uint32_t primitive) const {
    return {corner(primitive, 0), corner(primitive, 1), corner(primitive, 2)};
  }

 private:
  // Seldom, and by no means short: not a part of what calls it.
  glm::vec3 host_corner(std::uint32_t primitive, int which) const;
};

// Throws std::invalid_argument as OccluderBvh's constructor says.
PackedMesh pack(const TriangleMesh& mesh, MeshStorage storage = MeshStorage::copy);

// The same triangles at new positions, as many as before, kept in the same way.
PackedMesh moved(const PackedMesh& mesh, const PositionView& positions);

}  // namespace lkao::bvh
