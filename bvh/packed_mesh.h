// The mesh of a hierarchy: the one copy that builder and queries read.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "lkao/occluder_bvh.h"

namespace lkao::bvh {

// Every index is a position's.
struct PackedMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  glm::dvec3 origin{0};  // of the positions

  // Corner 0, 1 or 2 of a triangle.
  const glm::vec3& corner(std::uint32_t primitive, int which) const { return positions[triangles[primitive][which]]; }
};

// Throws std::invalid_argument as OccluderBvh's constructor says.
PackedMesh pack(const TriangleMesh& mesh);

}  // namespace lkao::bvh
