#include "lod/chain.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace lkao::lod {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(Chain, RangesTileAllDistances) {
  for (const float k : {0.5f, 2.0f, 3.3f, 5.0f, 1000.0f}) {
    for (const float growth : {1.1f, 3.0f, 10.0f}) {
      const Chain chain = empty_chain({.epsilon = 0.017f, .k = k, .growth = growth, .level_count = 7});
      ASSERT_EQ(chain.levels.size(), 7u);
      EXPECT_EQ(chain.levels.front().r_min, 0);
      EXPECT_EQ(chain.levels.back().r_max, kInfinity);
      for (std::size_t i = 0; i < chain.levels.size(); ++i) {
        EXPECT_LT(chain.levels[i].r_min, chain.levels[i].r_max);
        EXPECT_EQ(chain.levels[i].r_min, i > 0 ? chain.levels[i - 1].r_max : 0) << "level " << i;
      }
    }
  }
}

TEST(Chain, EpsilonsGrowAndRangesBeginKTimesAsFar) {
  const Chain chain = empty_chain({.epsilon = 0.5f, .k = 4, .growth = 3, .level_count = 4});
  const float epsilons[] = {0, 0.5f, 1.5f, 4.5f};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_FLOAT_EQ(chain.levels[i].epsilon, epsilons[i]);
    EXPECT_FLOAT_EQ(chain.levels[i].r_min, 4 * epsilons[i]);
  }
}

TEST(Chain, OneLevelIsTheOriginalEverywhere) {
  const Chain chain = empty_chain({.level_count = 1});
  ASSERT_EQ(chain.levels.size(), 1u);
  EXPECT_EQ(chain.levels[0].epsilon, 0);
  EXPECT_EQ(chain.levels[0].r_min, 0);
  EXPECT_EQ(chain.levels[0].r_max, kInfinity);
}

TEST(Chain, RejectsValuesOutOfRangeByName) {
  const auto expect_rejected = [](const LevelRule& rule, const std::string& name) {
    try {
      empty_chain(rule);
      ADD_FAILURE() << name;
    } catch (const std::invalid_argument& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(name + ": ")) << error.what();
    }
  };
  for (const float bad : {0.0f, -1.0f, kNan, kInfinity}) {
    expect_rejected({.epsilon = bad}, "epsilon");
    expect_rejected({.epsilon = 1, .k = bad}, "k");
    expect_rejected({.epsilon = 1, .growth = bad}, "growth");
  }
  expect_rejected({.epsilon = 1, .growth = 1}, "growth");
  expect_rejected({.epsilon = 1, .level_count = 0}, "level_count");
  expect_rejected({.epsilon = 1, .level_count = kMaxLevelCount + 1}, "level_count");
  expect_rejected({.epsilon = 1e30f, .growth = 1e5f, .level_count = 4}, "epsilon");  // beyond what a float holds
}

TEST(Chain, AutomaticEpsilonPutsTheLastLevelAtHalfTheRadius) {
  for (const int level_count : {2, 4, 6}) {
    LevelRule rule{.k = 2.5f, .growth = 3, .level_count = level_count};
    rule.epsilon = automatic_epsilon(2.25f, rule);
    EXPECT_NEAR(empty_chain(rule).levels.back().r_min, 2.25f / 2, 1e-6);
  }
  const scene::Mesh mesh{.positions = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, .triangles = {{0, 1, 2}}};
  EXPECT_EQ(automatic_epsilon(mesh, 2.25f, {}), automatic_epsilon(2.25f, {}));
  EXPECT_EQ(automatic_epsilon(mesh, kInfinity, {}), automatic_epsilon(5.0f, {}));  // the diagonal
  EXPECT_THROW(automatic_epsilon(0, {}), std::invalid_argument);
  EXPECT_THROW(automatic_epsilon(kNan, {}), std::invalid_argument);
}

}  // namespace
}  // namespace lkao::lod
