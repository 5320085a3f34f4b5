// Which triangles can block a ray at all: the one judgement that the whole project shares.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "lkao/occluder_bvh.h"
#include "lut/coordinates.h"

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

struct Corners {
  glm::vec3 a, b, c;
};

// Why a triangle blocks nothing.
enum class Defect { none, zero_area, non_finite };

inline Defect defect_of(const Corners& corners) {
  const auto& [a, b, c] = corners;
  if (!lut::is_in_range(a, b, c)) return Defect::non_finite;
  return has_zero_area(a, b, c) ? Defect::zero_area : Defect::none;
}

// Whether a hierarchy with such options has the triangle in its leaves.
inline bool is_kept(Defect defect, const BuildOptions& options) {
  return defect == Defect::none || (defect == Defect::zero_area && options.keep_zero_area);
}

}  // namespace lkao::bvh
