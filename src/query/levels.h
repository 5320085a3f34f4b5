// Levels of detail, prepared for the rays of one query.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bvh/ray_parts.h"
#include "lkao/ambient_occlusion.h"

namespace lkao::query {

struct Level {
  OccluderBvh occluders;
  std::optional<bvh::RayParts> parts;  // none where whole rays count
};

// For rays with the pattern's lengths times `radius`. Levels that begin behind all rays are left out, but the first.
std::vector<Level> make_levels(std::span<const OccluderLevel> levels, const SamplePattern& pattern, float radius);

}  // namespace lkao::query
