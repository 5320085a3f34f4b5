#include "lod/occluders.h"

#include <cstddef>
#include <cstdint>

namespace lkao::lod {
namespace {

bool saves_enough(const scene::Mesh& level, const scene::Mesh& finer) {
  return static_cast<double>(level.triangles.size()) <= kMostKeptShare * static_cast<double>(finer.triangles.size());
}

}  // namespace

std::vector<LevelInUse> levels_in_use(const Chain& chain, float radius) {
  std::vector<LevelInUse> levels;
  for (const Level& level : chain.levels) {
    if (level.r_min > 0 && level.r_min >= radius) break;
    if (levels.empty() || saves_enough(level.mesh, *levels.back().mesh)) {
      levels.push_back({&level.mesh, level.r_min, level.r_max});
    } else {
      levels.back().r_max = level.r_max;
    }
  }
  return levels;
}

std::vector<OccluderLevel> build_levels(const Chain& chain, float radius) {
  std::vector<OccluderLevel> levels;
  for (const LevelInUse& level : levels_in_use(chain, radius)) {
    levels.push_back({OccluderBvh(level.mesh->view()), level.r_min, level.r_max});
  }
  return levels;
}

RangedMesh merge(const Chain& chain, float radius) {
  RangedMesh merged;
  merged.mesh.origin = chain.levels[0].mesh.origin;
  for (const LevelInUse& level : levels_in_use(chain, radius)) {
    const auto first = static_cast<std::uint32_t>(merged.mesh.positions.size());
    const scene::Mesh& mesh = *level.mesh;
    merged.mesh.positions.insert(merged.mesh.positions.end(), mesh.positions.begin(), mesh.positions.end());
    for (const glm::uvec3& triangle : mesh.triangles) merged.mesh.triangles.push_back(triangle + first);
    merged.ranges.insert(merged.ranges.end(), mesh.triangles.size(), {level.r_min, level.r_max});
  }
  return merged;
}

}  // namespace lkao::lod
