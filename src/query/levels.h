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
  OccluderScene occluders;
  float r_min, r_max;  // r_max is infinite where it cuts no ray, r_min where the level blocks none
  // Which part of each ray counts, for rays of the query's radius. Absent where whole rays count, and where the radius
  // is infinite: then each receiver has a radius of its own.
  std::optional<bvh::RayParts> parts;

  bool is_whole() const { return r_min == 0 && r_max == std::numeric_limits<float>::infinity(); }
};

// For rays with the pattern's lengths times the radius, which count from options.min_distance on. Leaves out levels
// that begin where all rays have ended, and those that end where rays begin, but never the first.
std::vector<Level> make_levels(std::span<const OccluderLevel> levels, const SamplePattern& pattern,
                               const RayOptions& options);

}  // namespace lkao::query
