// What the kernels know of rays that are of no pattern: how long they are, and where they go.
#pragma once

#include <glm/mat3x3.hpp>

#include "bvh/pattern_cones.h"
#include "lkao/occlusion_mask.h"
#include "lkao/receiver_rays.h"

namespace lkao::bvh {

// Of some of a bundle's rays, which are no shorter than a thousandth of the longest of them. What rounding grants a ray
// is relative to the longest (TriangleTest), so rays of very different lengths are traced one kind after the other.
struct BundleShape {
  OcclusionMask rays;  // those in question; empty where no ray of those left has a length
  float radius = 0;    // none is longer
  // A rotation whose last column is a direction in their middle.
  glm::mat3 frame{1};
  // As ReceiverRays::up: that direction where all rays are above its horizon, else zero, which leaves nothing out.
  glm::vec3 up{0};
  PatternCones cones;  // in the space of `frame`, for chunks of 16 rays
};

// The longest rays of `left`, and those up to a thousand times shorter. `rays` has components of at most 1e18, and
// whole words of them (ReceiverRays). Radius and mask are the same on every instruction set; cones need not be, and no
// answer depends on them.
void make_bundle_shape(const ReceiverRays& rays, const OcclusionMask& left, BundleShape& shape);

// True where all components of the rays are numbers of at most 1e18.
bool are_in_range(const ReceiverRays& rays);

}  // namespace lkao::bvh
