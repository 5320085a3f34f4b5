#include "bake/padding.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "lut/random.h"

namespace lkao::bake {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

TextureMap unknown_map(int width, int height) {
  TextureMap map{.width = width, .height = height, .occlusion = {}, .bent_normals = {}, .coverage = {}};
  map.occlusion.assign(map.size(), kNaN);
  map.coverage.assign(map.size(), 0);
  return map;
}

TEST(Padding, GrowsByRings) {
  TextureMap map = unknown_map(9, 9);
  map.occlusion[map.texel(4, 4)] = 0.25f;
  grow(map, 2, {.wrap_u = Wrap::clamp, .wrap_v = Wrap::clamp});
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 9; ++x) {
      const float value = map.occlusion[map.texel(x, y)];
      if (std::max(std::abs(x - 4), std::abs(y - 4)) <= 2) {
        EXPECT_EQ(value, 0.25f) << x << " " << y;
      } else {
        EXPECT_TRUE(std::isnan(value)) << x << " " << y;
      }
    }
  }
}

TEST(Padding, IsTheMeanOfNeighboursAndLeavesTheseAlone) {
  TextureMap map = unknown_map(8, 4);
  map.bent_normals.assign(map.size(), glm::vec3(kNaN));
  map.occlusion[map.texel(2, 1)] = 0.2f;
  map.occlusion[map.texel(4, 1)] = 0.6f;
  map.bent_normals[map.texel(2, 1)] = {1, 0, 0};
  map.bent_normals[map.texel(4, 1)] = {0, 1, 0};
  grow(map, 1, {.wrap_u = Wrap::clamp, .wrap_v = Wrap::clamp});
  EXPECT_EQ(map.occlusion[map.texel(2, 1)], 0.2f);
  EXPECT_EQ(map.occlusion[map.texel(4, 1)], 0.6f);
  EXPECT_NEAR(map.occlusion[map.texel(3, 0)], 0.4f, 1e-6);
  EXPECT_EQ(map.occlusion[map.texel(1, 1)], 0.2f);
  EXPECT_NEAR(map.bent_normals[map.texel(3, 2)].y, std::sqrt(0.5f), 1e-6);
  EXPECT_TRUE(std::isnan(map.occlusion[map.texel(6, 1)]));
}

TEST(Padding, GoesOverEdgesThatRepeat) {
  const auto grown = [](const TextureOptions& options) {
    TextureMap map = unknown_map(8, 8);
    map.occlusion[map.texel(0, 4)] = 1;
    grow(map, 1, options);
    return map;
  };
  EXPECT_EQ(grown({}).occlusion[8 * 4 + 7], 1);
  EXPECT_TRUE(std::isnan(grown({.wrap_u = Wrap::mirror}).occlusion[8 * 4 + 7]));
  EXPECT_TRUE(std::isnan(grown({.udim = true}).occlusion[8 * 4 + 7]));
}

// The mip chain of the flooded map is that of the known texels alone, at every level.
TEST(Padding, EveryMipLevelIsCleanAfterAFlood) {
  TextureMap map = unknown_map(64, 32);
  lut::RandomStream random(3);
  for (int i = 0; i < 90; ++i) {
    map.occlusion[map.texel(static_cast<int>(random.next_below(40)), static_cast<int>(random.next_below(20)))] =
        static_cast<float>(random.next_double());
  }
  TextureMap flooded = map;
  flood(flooded);
  for (std::size_t i = 0; i < map.size(); ++i) {
    EXPECT_FALSE(std::isnan(flooded.occlusion[i]));
    if (!std::isnan(map.occlusion[i])) {
      EXPECT_EQ(flooded.occlusion[i], map.occlusion[i]);
    }
  }
  std::vector<float> known = map.occlusion, all = flooded.occlusion;
  for (int width = 32, height = 16; width >= 1 && height >= 1; width /= 2, height /= 2) {
    std::vector<float> known_half, all_half;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        float sum = 0, mean = 0;
        int count = 0;
        for (int i = 0; i < 4; ++i) {
          const auto child = static_cast<std::size_t>((2 * y + i / 2) * 2 * width + 2 * x + i % 2);
          mean += all[child] / 4;
          if (std::isnan(known[child])) continue;
          sum += known[child];
          ++count;
        }
        known_half.push_back(count > 0 ? sum / static_cast<float>(count) : kNaN);
        all_half.push_back(mean);
        if (count > 0) {
          EXPECT_NEAR(known_half.back(), mean, 1e-6);
        }
      }
    }
    known = known_half;
    all = all_half;
  }
}

TEST(Padding, AMapOfNothingStaysUnknown) {
  TextureMap map = unknown_map(5, 3);
  grow(map, 3, {});
  flood(map);
  for (const float value : map.occlusion) EXPECT_TRUE(std::isnan(value));
}

// Sizes that are no powers of two.
TEST(Padding, FloodsEverySize) {
  for (const int width : {1, 3, 7}) {
    TextureMap map = unknown_map(width, 5);
    map.occlusion[map.texel(width - 1, 4)] = 0.5f;
    flood(map);
    for (const float value : map.occlusion) EXPECT_EQ(value, 0.5f);
  }
}

}  // namespace
}  // namespace lkao::bake
