// Which part of each ray counts, where occluders own a range of distances: level of detail.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 4.3.
#pragma once

#include <span>

#include "lkao/occlusion_mask.h"

namespace lkao::bvh {

// A part is where the distance from the origin is in [r_min, r_max], and never behind the end of the ray.
struct RayParts {
  float near = 0;          // no part begins before, nearly: r_min
  float far = 0;           // no part ends behind, nearly: r_max or the longest ray
  OcclusionMask existing;  // rays that have such a part
  // As shares of the ray; 0 <= begin <= end <= 1.
  alignas(64) float begin[kMaxRayCount];
  alignas(64) float end[kMaxRayCount];
};

// Of rays with these lengths times `radius`; up to a whole word of a mask, rays without length follow. Where one range
// ends with the r_max that another begins with, their parts meet at the same float. 0 <= r_min < r_max, which may be
// infinite; with an infinite r_min no ray has a part.
RayParts make_ray_parts(std::span<const float> lengths, float radius, float r_min, float r_max);

}  // namespace lkao::bvh
