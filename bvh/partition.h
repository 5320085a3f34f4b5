// A set of pieces put into two, in place.
#pragma once

#include <cstddef>

#include "bvh/piece.h"

namespace lkao::bvh {

struct Halves {
  PieceSet left, right;

  bool are_both_filled() const { return left.size() != 0 && right.size() != 0; }
};

// Hands out the pieces of a set one by one; each is to be put to the left, to the right, or as two parts to both.
class Partition {
 public:
  Partition(Pieces& pieces, const PieceSet& set);

  bool has_next() const { return next_ < right_.begin; }
  Piece next() const { return pieces_[next_]; }
  bool has_room() const { return right_.end < right_.room_end; }
  void put_left(const Piece& piece);
  void put_right(const Piece& piece);
  // Only where there is room.
  void put_both(const Piece& left, const Piece& right);

  // Once there is no next piece. The room left over is shared out by the area of the pieces, since large triangles have
  // the most to gain from splits, and by their number, so that a distant backdrop does not take it all.
  Halves finish();

 private:
  Pieces& pieces_;
  PieceSet left_, right_;
  std::size_t next_;
};

}  // namespace lkao::bvh
