#include "query/levels.h"

namespace lkao::query {

std::vector<Level> make_levels(std::span<const OccluderLevel> levels, const SamplePattern& pattern, float radius) {
  std::vector<Level> result;
  for (const OccluderLevel& level : levels) {
    if (level.r_min >= radius && !result.empty()) continue;
    Level& prepared = result.emplace_back(Level{level.occluders, {}});
    const bool is_whole = level.r_min == 0 && level.r_max >= radius;
    if (!is_whole) prepared.parts = bvh::make_ray_parts(pattern.lengths(), radius, level.r_min, level.r_max);
  }
  return result;
}

}  // namespace lkao::query
