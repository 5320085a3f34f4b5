#include "bvh/partition.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace lkao::bvh {
namespace {

Piece square(float size, std::uint32_t primitive) { return Piece(Box{{0, 0, 0, 0}, {size, size, 0, 0}}, primitive); }

std::vector<std::uint32_t> primitives_of(const Pieces& pieces, const PieceSet& set) {
  std::vector<std::uint32_t> numbers;
  for (std::size_t i = set.begin; i < set.end; ++i) numbers.push_back(pieces[i].primitive());
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

// Ten pieces, five to the right but for number 3, which goes to both; `room` more fit behind them.
struct Parted {
  explicit Parted(std::size_t room) {
    PieceSet set;
    for (std::uint32_t i = 0; i < 10; ++i) pieces.push_back(square(i < 5 ? 1.0f : 3.0f, i));
    set.end = pieces.size();
    pieces.resize(pieces.size() + room);
    set.room_end = pieces.size();
    Partition partition(pieces, set);
    while (partition.has_next()) {
      const Piece piece = partition.next();
      if (piece.primitive() == 3) {
        partition.put_both(piece, piece);
      } else if (piece.primitive() < 5) {
        partition.put_left(piece);
      } else {
        partition.put_right(piece);
      }
    }
    halves = partition.finish();
  }

  Pieces pieces;
  Halves halves;
};

TEST(Partition, KeepsEveryPieceWhateverTheRoom) {
  for (const std::size_t room : {1u, 2u, 7u, 100u}) {
    const Parted parted(room);
    EXPECT_EQ(primitives_of(parted.pieces, parted.halves.left), (std::vector<std::uint32_t>{0, 1, 2, 3, 4}));
    EXPECT_EQ(primitives_of(parted.pieces, parted.halves.right), (std::vector<std::uint32_t>{3, 5, 6, 7, 8, 9}));
  }
}

TEST(Partition, SharesTheRoomByAreaAndNumber) {
  const Parted parted(101);  // 100 are left: 5 of 11 pieces on the left, 5 of 51 units of area
  EXPECT_EQ(parted.halves.left.room(), 27u);
  EXPECT_EQ(parted.halves.right.room(), 73u);
  EXPECT_EQ(parted.halves.left.room_end, parted.halves.right.begin);
  EXPECT_EQ(parted.halves.left.bounds.upper[0], 1);
  EXPECT_EQ(parted.halves.right.bounds.upper[0], 3);
}

}  // namespace
}  // namespace lkao::bvh
