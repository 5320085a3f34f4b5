#include "query/levels.h"

#include <algorithm>
#include <cmath>

namespace lkao::query {

std::vector<Level> make_levels(std::span<const OccluderLevel> levels, const SamplePattern& pattern,
                               const RayOptions& options) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const float radius = options.radius;
  std::vector<Level> result;
  for (const OccluderLevel& level : levels) {
    const float begin = std::max(level.r_min, options.min_distance);
    if ((begin >= radius || begin >= level.r_max) && !result.empty()) continue;
    const float r_min = begin < level.r_max ? begin : kInfinity;
    const float r_max = level.r_max >= radius ? kInfinity : level.r_max;
    Level& prepared = result.emplace_back(Level{level.occluders, r_min, r_max, {}});
    if (!prepared.is_whole() && std::isfinite(radius)) {
      prepared.parts = bvh::make_ray_parts(pattern.lengths(), radius, r_min, r_max);
    }
  }
  return result;
}

}  // namespace lkao::query
