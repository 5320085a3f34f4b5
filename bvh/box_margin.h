// From what a child of a node holds to the box that the node has for it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "bvh/layout.h"

namespace lkao::bvh {

// Faces move out: see Node.
inline Bounds with_margin(const Bounds& bounds) {
  constexpr float kOutside = std::numeric_limits<float>::infinity();
  Bounds box;
  for (int axis = 0; axis < 3; ++axis) {
    const float lower = bounds.lower[axis], upper = bounds.upper[axis];
    box.lower[axis] = std::min(std::nextafter(lower, -kOutside), lower - Node::kMargin);
    box.upper[axis] = std::max(std::nextafter(upper, kOutside), upper + Node::kMargin);
  }
  return box;
}

}  // namespace lkao::bvh
