// Splitting a set of pieces by their centers, with the surface area heuristic.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "bvh/piece.h"

namespace lkao::bvh {

// What leaves over so many pieces cost: a test for every 4 triangles.
inline float leaf_cost(std::size_t piece_count) {
  const std::size_t leaf_count = (piece_count + 3) / 4;
  return static_cast<float>(leaf_count);
}

// Which bin a piece belongs to, by its center, along each axis.
class CenterMap {
 public:
  static constexpr int kMaxBins = 32;

  CenterMap() = default;
  explicit CenterMap(const PieceSet& set);

  int bin_count() const { return bin_count_; }
  bool is_flat(int axis) const { return scale_[axis] == 0; }
  IntLanes bins_of(const Piece& piece) const {
    return __builtin_convertvector((piece.twice_center() - origin_) * scale_, IntLanes);
  }
  bool is_left(const Piece& piece, int axis, int first_right_bin) const {
    return bins_of(piece)[axis] < first_right_bin;
  }

 private:
  Lanes origin_, scale_;
  int bin_count_;
};

struct ObjectSplit {
  float cost = std::numeric_limits<float>::infinity();  // sum of area x leaf_cost; infinite: no split
  int axis = 0, first_right_bin = 0;
  Box left = empty_box(), right = empty_box();
};

// Bins over the pieces of one set. Parts of the set may be binned apart and merged: the result is the same to the bit.
class ObjectBins {
 public:
  explicit ObjectBins(const CenterMap& map);
  void add(std::span<const Piece> pieces, const CenterMap& map);
  void merge_with(const ObjectBins& other, const CenterMap& map);
  ObjectSplit best(const CenterMap& map) const;

 private:
  Box boxes_[3][CenterMap::kMaxBins];
  std::uint32_t counts_[3][CenterMap::kMaxBins];
};

}  // namespace lkao::bvh
