#include "lod/occluders.h"

#include <algorithm>
#include <cstdint>

namespace lkao::lod {

std::span<const Level> levels_within(const Chain& chain, float radius) {
  const auto last = std::find_if(chain.levels.begin(), chain.levels.end(),
                                 [radius](const Level& level) { return level.r_min > 0 && level.r_min >= radius; });
  return {chain.levels.begin(), last};
}

std::vector<OccluderLevel> build_levels(const Chain& chain, float radius) {
  std::vector<OccluderLevel> levels;
  for (const Level& level : levels_within(chain, radius)) {
    levels.push_back({OccluderBvh(level.mesh.view()), level.r_min, level.r_max});
  }
  return levels;
}

RangedMesh merge(const Chain& chain, float radius) {
  RangedMesh merged;
  for (const Level& level : levels_within(chain, radius)) {
    const auto first = static_cast<std::uint32_t>(merged.mesh.positions.size());
    merged.mesh.positions.insert(merged.mesh.positions.end(), level.mesh.positions.begin(), level.mesh.positions.end());
    for (const glm::uvec3& triangle : level.mesh.triangles) merged.mesh.triangles.push_back(triangle + first);
    merged.ranges.insert(merged.ranges.end(), level.mesh.triangles.size(), {level.r_min, level.r_max});
  }
  return merged;
}

}  // namespace lkao::lod
