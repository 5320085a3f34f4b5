// Levels of detail, prepared for the rays of one query.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "bvh/ray_parts.h"
#include "lkao/ambient_occlusion.h"

namespace lkao::query {

struct Level {
  OccluderBvh occluders;
  float r_min, r_max;  // r_max is infinite where it cuts no ray
  // Which part of each ray counts, for rays of the query's radius. Absent where whole rays count, and where the radius
  // is infinite: then each receiver has a radius of its own.
  std::optional<bvh::RayParts> parts;

  bool is_whole() const { return r_min == 0 && r_max == std::numeric_limits<float>::infinity(); }
};

// For rays with the pattern's lengths times `radius`. Leaves out levels that begin where all rays have ended, but never
// the first.
std::vector<Level> make_levels(std::span<const OccluderLevel> levels, const SamplePattern& pattern, float radius);

}  // namespace lkao::query
