#include "lut/hilbert.h"

#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace lkao::lut {
namespace {

// On a coarse grid the curve passes every cell once, and each step goes to a neighbour.
TEST(Hilbert, StepsFromCellToNeighbouringCell) {
  constexpr int kSide = 16;
  std::vector<std::pair<int, int>> cells(kSide * kSide, {-1, -1});
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const glm::vec2 center = (glm::vec2(x, y) + 0.5f) * (2.0f / kSide) - 1.0f;
      const std::uint32_t index = hilbert_index(center) >> 24;  // 2 x 4 bits of 2 x 16
      EXPECT_EQ(cells[index].first, -1) << "two cells at " << index;
      cells[index] = {x, y};
    }
  }
  for (std::size_t i = 1; i < cells.size(); ++i) {
    EXPECT_EQ(std::abs(cells[i].first - cells[i - 1].first) + std::abs(cells[i].second - cells[i - 1].second), 1) << i;
  }
}

TEST(Hilbert, TakesTheBorder) {
  EXPECT_EQ(hilbert_index({1.0f, -1.0f}), 0xffffffffu);
  EXPECT_EQ(hilbert_index({-1.0f, -1.0f}), 0u);
  EXPECT_NO_FATAL_FAILURE(hilbert_index({2.0f, -3.0f}));
}

}  // namespace
}  // namespace lkao::lut
