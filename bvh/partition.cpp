#include "bvh/partition.h"

#include <algorithm>

namespace lkao::bvh {

Partition::Partition(Pieces& pieces, const PieceSet& set) : pieces_(pieces), next_(set.begin) {
  left_.begin = set.begin;
  right_.begin = right_.end = set.end;
  right_.room_end = set.room_end;
}

void Partition::put_left(const Piece& piece) {
  left_.include(piece);
  pieces_[next_++] = piece;
}

void Partition::put_right(const Piece& piece) {
  right_.include(piece);
  pieces_[next_] = pieces_[--right_.begin];
  pieces_[right_.begin] = piece;
}

void Partition::put_both(const Piece& left, const Piece& right) {
  put_left(left);
  right_.include(right);
  pieces_[right_.end++] = right;
}

Halves Partition::finish() {
  left_.end = right_.begin;
  const std::size_t room = right_.room();
  const double area = left_.area + right_.area;
  const double count = static_cast<double>(left_.size() + right_.size());
  const double left_of_count = static_cast<double>(right_.begin - left_.begin) / count;
  const double left_share = 0.5 * (left_of_count + (area > 0 ? left_.area / area : left_of_count));
  const std::size_t left_room = std::min(static_cast<std::size_t>(left_share * static_cast<double>(room)), room);
  // The room of the left half lies between the two. The order of pieces is free: only as many as needed move.
  const std::size_t moved = std::min(left_room, right_.size());
  std::copy_n(&pieces_[right_.begin], moved, &pieces_[right_.end] + (left_room - moved));
  left_.room_end = left_.end + left_room;
  right_.begin += left_room;
  right_.end += left_room;
  return {left_, right_};
}

}  // namespace lkao::bvh
