// Which triangles can block a ray at all: the one judgement that the whole project shares.
#pragma once

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace lkao::bvh {

// True where no coordinate is NaN or infinite.
inline bool is_finite(const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

// True where every coordinate is a number of at most kLargestCoordinate: beyond it the arithmetic of single precision
// overflows.
inline constexpr float kLargestCoordinate = 1e18f;
inline bool is_in_range(const glm::vec3& p) {
  return std::fabs(p.x) <= kLargestCoordinate && std::fabs(p.y) <= kLargestCoordinate &&
         std::fabs(p.z) <= kLargestCoordinate;
}
inline bool is_in_range(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return is_in_range(a) && is_in_range(b) && is_in_range(c);
}

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
