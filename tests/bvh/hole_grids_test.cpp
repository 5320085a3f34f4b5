#include "bvh/hole_grids.h"

#include <atomic>
#include <cstdint>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "bvh/cut_outs.h"
#include "bvh/leaf.h"
#include "support/sanitized.h"

namespace lkao::bvh {
namespace {

bool blocks_all(std::uint32_t, std::uint32_t, float, float) { return true; }

// Opaque below a line across the triangle.
CutOutPart below_line(std::uint32_t, float u0, float v0, float size) {
  if (u0 + size + 2 * (v0 + size) < 0.7f) return CutOutPart::opaque;
  return u0 + 2 * v0 > 0.7f ? CutOutPart::clear : CutOutPart::mixed;
}

TEST(HoleGrids, KnowNothingWithoutASurvey) {
  const HoleGrids grids({.blocks = blocks_all}, 3);
  EXPECT_EQ(grids.at(2, 0.1f, 0.2f), CutOutPart::mixed);
  EXPECT_EQ(grids.of(2), CutOutPart::mixed);
  EXPECT_EQ(grids.entries(), nullptr);
  EXPECT_EQ(HoleGrids().memory_bytes(), 0u);
}

TEST(HoleGrids, SayWhatTheSurveySays) {
  const HoleGrids grids({.blocks = blocks_all, .survey = below_line}, 1);
  constexpr int kCount = 200;
  int mixed_count = 0, count = 0;
  for (int i = 0; i <= kCount; ++i) {
    for (int k = 0; i + k <= kCount; ++k, ++count) {
      const float u = static_cast<float>(i) / kCount, v = static_cast<float>(k) / kCount;
      const CutOutPart part = grids.at(0, u, v);
      if (part == CutOutPart::mixed) {
        ++mixed_count;
      } else {
        ASSERT_EQ(u + 2 * v < 0.7f, part == CutOutPart::opaque) << u << ", " << v;
      }
    }
  }
  EXPECT_GT(mixed_count, 0);
  EXPECT_LT(mixed_count, count / 20);
}

TEST(HoleGrids, AskOnceOfEachLook) {
  std::atomic<int> count_of[6] = {};
  const auto survey = [&](std::uint32_t primitive, float, float, float) {
    ++count_of[primitive];
    return primitive == 0 ? CutOutPart::clear : CutOutPart::opaque;
  };
  const HoleGrids grids({{0, 0, 0, 0, 1, 0}, blocks_all, survey, {7, 5, 7, 5, 9, 7}}, 6);
  const int expected[] = {1, 1, 0, 0, 0, 0};
  for (std::uint32_t i = 0; i < 6; ++i) EXPECT_EQ(count_of[i], expected[i]) << i;
  EXPECT_EQ(grids.of(5), CutOutPart::clear);
  EXPECT_EQ(grids.of(3), CutOutPart::opaque);
  EXPECT_EQ(grids.of(4), CutOutPart::mixed);  // whole, and not asked
}

// Were each as fine as one alone, these would take 16 KB each.
TEST(HoleGrids, OfManyAreSmall) {
  constexpr std::size_t kCount = tests::unless_sanitized(100000, 3000);
  const auto survey = [](std::uint32_t, float, float, float) { return CutOutPart::mixed; };
  EXPECT_LE(HoleGrids({.blocks = blocks_all, .survey = survey}, kCount).memory_bytes(), std::size_t{4} << 20);
  EXPECT_EQ(HoleGrids({.blocks = blocks_all, .survey = survey}, 1).memory_bytes(), 4 * (1 + 1 + (1u << 12)));
}

TEST(HoleGrids, MakeWhatIsAllOpaqueWhole) {
  const PackedMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 1, 2}}};
  const CutOuts cut_outs{.blocks = blocks_all, .survey = [](std::uint32_t primitive, float, float, float) {
                           return primitive == 0 ? CutOutPart::opaque : CutOutPart::clear;
                         }};
  const HoleGrids grids(cut_outs, 2);
  const Leaf leaf = make_leaf(mesh, std::vector<std::uint32_t>{0, 1}, cut_outs, &grids);
  EXPECT_GT(leaf.steepness[0], 0);
  EXPECT_LT(leaf.steepness[1], 0);
}

}  // namespace
}  // namespace lkao::bvh
