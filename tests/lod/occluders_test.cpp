// Chains as the methods take them.
#include "lod/occluders.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "lod/meshes.h"

namespace lkao::lod {
namespace {

constexpr float kFar = 1e6f;

// Levels of so many triangles, each the first of a grid's.
Chain levels_of(const std::vector<std::size_t>& triangle_counts) {
  const auto level_count = static_cast<int>(triangle_counts.size());
  Chain chain = empty_chain({.epsilon = 0.01f, .k = 2, .level_count = level_count});
  for (std::size_t i = 0; i < triangle_counts.size(); ++i) {
    scene::Mesh& mesh = chain.levels[i].mesh;
    mesh = flat_grid(10);
    mesh.triangles.resize(triangle_counts[i]);
  }
  return chain;
}

// What levels of so many triangles come to: the counts of those in use, and where their ranges end.
void expect_in_use(const std::vector<std::size_t>& triangle_counts, const std::vector<std::size_t>& in_use) {
  const Chain chain = levels_of(triangle_counts);
  const std::vector<LevelInUse> levels = levels_in_use(chain, kFar);
  ASSERT_EQ(levels.size(), in_use.size());
  float begin = 0;
  for (std::size_t i = 0, next = 0; i < levels.size(); ++i) {
    while (chain.levels[next].mesh.triangles.size() != in_use[i]) ++next;
    EXPECT_EQ(levels[i].mesh, &chain.levels[next].mesh);
    EXPECT_EQ(levels[i].r_min, chain.levels[next].r_min);
    EXPECT_EQ(levels[i].r_min, begin) << "a gap";
    begin = levels[i].r_max;
  }
  EXPECT_EQ(begin, std::numeric_limits<float>::infinity());
  EXPECT_EQ(build_levels(chain, kFar).size(), in_use.size());
}

TEST(Occluders, OfAllLevelsKeepTheirRanges) {
  const Chain chain = levels_of({100, 30, 20});
  const RangedMesh merged = merge(chain, kFar);
  const std::vector<OccluderLevel> levels = build_levels(chain, kFar);
  ASSERT_EQ(levels.size(), 3u);
  ASSERT_EQ(merged.ranges.size(), merged.mesh.triangles.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Level& level = chain.levels[i];
    EXPECT_EQ(levels[i].occluders.mesh(0).report().triangle_count, level.mesh.triangles.size());
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
  const Chain chain = levels_of({100, 30, 20});
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

// Measured against the next finer level in use, not against the scene. Three quarters are few enough.
TEST(Occluders, LeaveOutLevelsThatSaveLittle) {
  expect_in_use({100, 59, 51, 48}, {100, 59});
  expect_in_use({100, 95, 52, 50}, {100, 52});
  expect_in_use({100, 75, 50, 10}, {100, 75, 50, 10});
  expect_in_use({100, 76, 74, 56}, {100, 74});
  expect_in_use({100, 100, 100, 100}, {100});
}

// A level beyond the radius takes nothing over from those that are left out.
TEST(Occluders, TheLastLevelInUseReachesTheRadius) {
  const Chain chain = levels_of({100, 90, 80, 10});
  const std::vector<LevelInUse> levels = levels_in_use(chain, chain.levels[3].r_min);
  ASSERT_EQ(levels.size(), 1u);
  EXPECT_EQ(levels[0].r_max, chain.levels[3].r_min);
  EXPECT_EQ(merge(chain, chain.levels[3].r_min).ranges.back(), glm::vec2(0, chain.levels[3].r_min));
}

}  // namespace
}  // namespace lkao::lod
