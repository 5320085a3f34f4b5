#include "query/levels.h"

#include <cmath>

namespace lkao::query {

std::vector<Level> make_levels(std::span<const OccluderLevel> levels, const SamplePattern& pattern, float radius) {
  std::vector<Level> result;
  for (const OccluderLevel& level : levels) {
    if (level.r_min >= radius && !result.empty()) continue;
    const float r_max = level.r_max >= radius ? std::numeric_limits<float>::infinity() : level.r_max;
    Level& prepared = result.emplace_back(Level{level.occluders, level.r_min, r_max, {}});
    if (!prepared.is_whole() && std::isfinite(radius)) {
      prepared.parts = bvh::make_ray_parts(pattern.lengths(), radius, level.r_min, r_max);
    }
  }
  return result;
}

}  // namespace lkao::query
