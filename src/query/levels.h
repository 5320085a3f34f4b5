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
  // Of rays of the query's radius; none where that is infinite, since each receiver has a radius of its own then, or
  // where whole rays count.
  std::optional<bvh::RayParts> parts;

  bool is_whole() const { return r_min == 0 && r_max == std::numeric_limits<float>::infinity(); }
};

// For rays with the pattern's lengths times `radius`. Levels that begin behind all rays are left out, but the first.
std::vector<Level> make_levels(std::span<const OccluderLevel> levels, const SamplePattern& pattern, float radius);

}  // namespace lkao::query
