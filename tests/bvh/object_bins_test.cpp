#include "bvh/object_bins.h"

#include <vector>

#include <gtest/gtest.h>

namespace lkao::bvh {
namespace {

Piece cube_at(float x, float y, std::uint32_t primitive) {
  return Piece(Box{{x, y, 0, 0}, {x + 1, y + 1, 1, 0}}, primitive);
}

PieceSet set_of(const std::vector<Piece>& pieces) {
  PieceSet set;
  set.end = set.room_end = pieces.size();
  for (const Piece& piece : pieces) set.include(piece);
  return set;
}

TEST(Piece, KeepsTheNumberOfItsTriangle) {
  for (const std::uint32_t number : {0u, 1u, 0xffffu, 0x10000u, 0x12345678u, 0xfffffffeu}) {
    EXPECT_EQ(cube_at(0, 0, number).primitive(), number);
  }
}

// Two groups, far apart in y: the split lies between them, and costs two boxes of 4 pieces.
TEST(ObjectBins, SplitsBetweenTwoGroups) {
  std::vector<Piece> pieces;
  for (std::uint32_t i = 0; i < 8; ++i) pieces.push_back(cube_at(static_cast<float>(i % 4), i < 4 ? 0.0f : 100.0f, i));
  const CenterMap map(set_of(pieces));
  ObjectBins bins(map);
  bins.add(pieces, map);
  const ObjectSplit split = bins.best(map);
  EXPECT_EQ(split.axis, 1);
  EXPECT_EQ(split.cost, 2 * (4 * 1 + 4 * 1 + 1 * 1));
  for (std::uint32_t i = 0; i < 8; ++i) {
    EXPECT_EQ(map.is_left(pieces[i], split.axis, split.first_right_bin), i < 4) << i;
  }
  EXPECT_EQ(split.left.upper[1], 1);
  EXPECT_EQ(split.right.lower[1], 100);
}

TEST(ObjectBins, FindNothingWhereCentersAreEqual) {
  const std::vector<Piece> pieces(10, cube_at(2, 3, 0));
  const CenterMap map(set_of(pieces));
  ObjectBins bins(map);
  bins.add(pieces, map);
  EXPECT_EQ(bins.best(map).cost, std::numeric_limits<float>::infinity());
}

}  // namespace
}  // namespace lkao::bvh
