// Boxes around triangles.
#pragma once

#include <limits>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "bvh/usable_triangle.h"
#include "lkao/occluder_bvh.h"

namespace lkao::bvh {

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

// The box around nothing, as a beginning for merge().
inline constexpr Bounds kNowhere{glm::vec3(kInfinity), glm::vec3(-kInfinity)};

inline bool is_nowhere(const Bounds& box) { return box.lower.x > box.upper.x; }

inline Bounds merge(const Bounds& a, const Bounds& b) {
  return {glm::min(a.lower, b.lower), glm::max(a.upper, b.upper)};
}

// Half of its surface. Of boxes that hold something.
inline double half_area(const Bounds& box) {
  const glm::dvec3 size = glm::dvec3(box.upper) - glm::dvec3(box.lower);
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

inline Bounds bounds_of(const Corners& corners) {
  const auto& [a, b, c] = corners;
  return {glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))};
}

}  // namespace lkao::bvh
