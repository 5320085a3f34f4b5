#include "bvh/triangle_clip.h"

#include <algorithm>
#include <limits>

#include <glm/common.hpp>

namespace lkao::bvh {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

void extend(Bounds& bounds, const glm::vec3& point) {
  bounds.lower = glm::min(bounds.lower, point);
  bounds.upper = glm::max(bounds.upper, point);
}

// Extends the bounds by a computed point, a step of float outwards: its rounding errors, made in double, are smaller.
void extend_rounded(Bounds& bounds, const glm::dvec3& point) {
  constexpr float kTiny = std::numeric_limits<float>::min();
  const glm::vec3 rounded(point);
  const glm::vec3 step = glm::abs(rounded) * 0x1p-23f + kTiny;
  bounds.lower = glm::min(bounds.lower, rounded - step);
  bounds.upper = glm::max(bounds.upper, rounded + step);
}

Bounds intersection(const Bounds& a, const Bounds& b) {
  return {glm::max(a.lower, b.lower), glm::min(a.upper, b.upper)};
}

}  // namespace

SplitBounds clip_triangle(const glm::vec3 (&corners)[3], const Bounds& within, int axis, float position) {
  const Bounds empty{glm::vec3(kInfinity), glm::vec3(-kInfinity)};
  SplitBounds split{empty, empty};
  for (int i = 0; i < 3; ++i) {
    const glm::vec3& from = corners[i];
    const glm::vec3& to = corners[(i + 1) % 3];
    if (from[axis] <= position) extend(split.left, from);
    if (from[axis] >= position) extend(split.right, from);
    if ((from[axis] < position && position < to[axis]) || (to[axis] < position && position < from[axis])) {
      const glm::dvec3 start(from), end(to);
      const double share = (static_cast<double>(position) - start[axis]) / (end[axis] - start[axis]);
      const glm::dvec3 crossing = start + share * (end - start);
      extend_rounded(split.left, crossing);
      extend_rounded(split.right, crossing);
    }
  }
  split.left.upper[axis] = std::min(split.left.upper[axis], position);
  split.right.lower[axis] = std::max(split.right.lower[axis], position);
  return {intersection(split.left, within), intersection(split.right, within)};
}

}  // namespace lkao::bvh
