// Which triangles can block a ray at all: the one judgement that the whole project shares.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace lkao::bvh {

// (b - a) x (c - a) in double precision, from the float corners. Neither overflows nor underflows for finite floats.
// Compile with -ffp-contract=off: a fused product would leave a rounding residue on collinear corners.
inline glm::dvec3 area_vector(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::dvec3 origin(a);
  return glm::cross(glm::dvec3(b) - origin, glm::dvec3(c) - origin);
}

// True where the corners lie on one line (or two are equal), so that the triangle has no plane. Exact for coordinates
// of similar magnitude, whose differences and products fit a double. The corners must be finite.
inline bool has_zero_area(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return area_vector(a, b, c) == glm::dvec3(0.0);
}

}  // namespace lkao::bvh
