// Chains as the methods take them.
#include "lod/occluders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "scene/builtin.h"

namespace lkao::lod {
namespace {

constexpr float kFar = 1e6f;

// Three levels that are nothing alike.
Chain different_levels() {
  Chain chain = empty_chain({.epsilon = 0.01f, .k = 2, .level_count = 3});
  chain.levels[0].mesh = scene::make_builtin("box");
  chain.levels[1].mesh = scene::make_builtin("plane");
  chain.levels[2].mesh = scene::make_builtin("wall");
  return chain;
}

TEST(Occluders, OfAllLevelsKeepTheirRanges) {
  const Chain chain = different_levels();
  const RangedMesh merged = merge(chain, kFar);
  const std::vector<OccluderLevel> levels = build_levels(chain, kFar);
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

TEST(Occluders, EndWithTheRadius) {
  const Chain chain = different_levels();
  std::size_t triangle_count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    // A level counts from where the radius is beyond its beginning, not at it.
    triangle_count += chain.levels[i].mesh.triangles.size();
    const float end = chain.levels[i].r_max;
    for (const float radius : {std::nextafter(chain.levels[i].r_min, kFar), std::min(end, kFar)}) {
      EXPECT_EQ(build_levels(chain, radius).size(), i + 1) << "radius " << radius;
      EXPECT_EQ(merge(chain, radius).mesh.triangles.size(), triangle_count) << "radius " << radius;
    }
  }
}

}  // namespace
}  // namespace lkao::lod
