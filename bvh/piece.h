// A triangle, or a part of one that spatial splits made, while a hierarchy is built.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bvh/huge_pages.h"
#include "bvh/lanes.h"

namespace lkao::bvh {

// A box, and the number of the triangle in its last lanes: as two whole numbers of 16 bits, since arithmetic on bits
// that happen to be a denormal number or no number would be slow.
struct Piece {
  Box box;

  Piece() = default;
  Piece(const Box& bounds, std::uint32_t primitive) : box(bounds) {
    box.lower[3] = static_cast<float>(primitive & 0xffff);
    box.upper[3] = static_cast<float>(primitive >> 16);
  }

  std::uint32_t primitive() const {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(box.lower[3])) |
           static_cast<std::uint32_t>(static_cast<std::int32_t>(box.upper[3])) << 16;
  }
  Lanes twice_center() const { return box.lower + box.upper; }
};

// Their allocator leaves reserved memory untouched until the builder writes to it.
using Pieces = std::vector<Piece, HugePageAllocator<Piece>>;

// Some pieces that lie one behind the other, and what bounds them.
struct PieceSet {
  std::size_t begin = 0, end = 0;
  std::size_t room_end = 0;  // pieces from splits may be put from `end` to here
  Box bounds = empty_box();
  Box centers = empty_box();  // of twice the centers
  double area = 0;            // half the surface of the pieces' boxes, summed up

  std::size_t size() const { return end - begin; }
  std::size_t room() const { return room_end - end; }
  // Of two halves together as of the whole.
  std::size_t size_with_room() const { return room_end - begin; }
  void include(const Piece& piece) {
    bounds = merge(bounds, piece.box);
    centers = merge(centers, piece.twice_center());
    area += static_cast<double>(half_area(piece.box));
  }
};

}  // namespace lkao::bvh
