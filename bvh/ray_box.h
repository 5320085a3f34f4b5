// May a ray meet a box? Conservative: rounding may keep a ray that misses, never drop one that hits.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/vec3.hpp>

#include "lkao/occluder_bvh.h"

namespace lkao::bvh {

// A ray prepared for box tests. The reciprocal of a zero (or denormal) component is made finite.
struct BoxRay {
  BoxRay() = default;
  explicit BoxRay(const glm::vec3& ray) : reciprocal(safe(ray.x), safe(ray.y), safe(ray.z)) {}

  glm::vec3 reciprocal{0};

 private:
  static float safe(float component) {
    const float reciprocal = 1.0f / component;
    return std::isinf(reciprocal) ? std::copysign(std::numeric_limits<float>::max(), component) : reciprocal;
  }
};

// Granted to comparisons, for rounding.
inline constexpr float kBoxSlack = 0x1p-20f;

// The slab test over the segment's parameter range [begin, end]. Difference, reciprocal and product round once each, so
// each parameter is within 3 x 2^-24 of the truth; the test grants both ends of the overlap more than that. A ray that
// runs within the plane of a face misses the box: the boxes of nodes are a step larger than what they hold (layout.h).
inline bool may_meet(const BoxRay& ray, const glm::vec3& origin, const Bounds& box, float begin = 0.0f,
                     float end = 1.0f) {
  float enter = begin, leave = end;
  for (int axis = 0; axis < 3; ++axis) {
    const float at_lower = (box.lower[axis] - origin[axis]) * ray.reciprocal[axis];
    const float at_upper = (box.upper[axis] - origin[axis]) * ray.reciprocal[axis];
    enter = std::max(enter, std::min(at_lower, at_upper));
    leave = std::min(leave, std::max(at_lower, at_upper));
  }
  return enter <= leave * (1.0f + kBoxSlack);
}

// True where all points of the two boxes are farther than `distance` from each other. Conservative as above.
inline bool is_farther_than(float distance, const Bounds& a, const Bounds& b) {
  float distance2 = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float gap = std::max({0.0f, a.lower[axis] - b.upper[axis], b.lower[axis] - a.upper[axis]});
    distance2 += gap * gap;
  }
  return distance2 > distance * distance * (1.0f + 2.0f * kBoxSlack);
}

// True where the box lies outside the sphere of radius `far` around `origin`, wholly within that of radius `near`, or
// wholly below the horizon of `up` there (Laine & Karras 2010, Sec. 5): no ray can meet it. Conservative as above.
inline bool is_out_of_reach(const Bounds& box, const glm::vec3& origin, const glm::vec3& up, float near, float far) {
  float highest = 0, magnitude = 0, farthest2 = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float lower = box.lower[axis] - origin[axis], upper = box.upper[axis] - origin[axis];
    farthest2 += std::max(lower * lower, upper * upper);
    const float height_of_lower = up[axis] * lower, height_of_upper = up[axis] * upper;
    highest += std::max(height_of_lower, height_of_upper);
    magnitude += std::max(std::fabs(height_of_lower), std::fabs(height_of_upper));
  }
  return is_farther_than(far, box, {origin, origin}) || farthest2 * (1.0f + 2.0f * kBoxSlack) < near * near ||
         highest < -magnitude * kBoxSlack;
}

}  // namespace lkao::bvh
