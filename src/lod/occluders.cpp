#include "lod/occluders.h"

#include <cstdint>

namespace lkao::lod {

std::vector<OccluderLevel> build_levels(const Chain& chain) {
  std::vector<OccluderLevel> levels;
  for (const Level& level : chain.levels) {
    levels.push_back({OccluderBvh(level.mesh.view()), level.r_min, level.r_max});
  }
  return levels;
}

RangedMesh merge(const Chain& chain) {
  RangedMesh merged;
  for (const Level& level : chain.levels) {
    const auto first = static_cast<std::uint32_t>(merged.mesh.positions.size());
    merged.mesh.positions.insert(merged.mesh.positions.end(), level.mesh.positions.begin(), level.mesh.positions.end());
    for (const glm::uvec3& triangle : level.mesh.triangles) merged.mesh.triangles.push_back(triangle + first);
    merged.ranges.insert(merged.ranges.end(), level.mesh.triangles.size(), {level.r_min, level.r_max});
  }
  return merged;
}

}  // namespace lkao::lod
