// Chains as the methods take them.
#include "lod/occluders.h"

#include <gtest/gtest.h>

#include <limits>

#include "lod/simplify.h"
#include "scene/builtin.h"

namespace lkao::lod {
namespace {

TEST(Occluders, OfAllLevelsKeepTheirRanges) {
  const Chain chain =
      simplify(scene::make_builtin("sphere"), {.levels = {.epsilon = 0.01f, .k = 2, .level_count = 3}}).chain;
  const RangedMesh merged = merge(chain);
  const std::vector<OccluderLevel> levels = build_levels(chain);
  ASSERT_EQ(levels.size(), 3u);
  ASSERT_EQ(merged.ranges.size(), merged.mesh.triangles.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Level& level = chain.levels[i];
    EXPECT_EQ(levels[i].occluders.report().triangle_count, level.mesh.triangles.size());
    EXPECT_EQ(levels[i].r_min, level.r_min);
    EXPECT_EQ(levels[i].r_max, level.r_max);
    for (const glm::uvec3& t : level.mesh.triangles) {
      EXPECT_EQ(merged.ranges[next], glm::vec2(level.r_min, level.r_max));
      const glm::uvec3& m = merged.mesh.triangles[next++];
      for (int corner = 0; corner < 3; ++corner) {
        ASSERT_EQ(merged.mesh.positions[m[corner]], level.mesh.positions[t[corner]]);
      }
    }
  }
  EXPECT_EQ(next, merged.mesh.triangles.size());
  EXPECT_EQ(levels[0].r_min, 0);
  EXPECT_EQ(levels[2].r_max, std::numeric_limits<float>::infinity());
}

}  // namespace
}  // namespace lkao::lod
