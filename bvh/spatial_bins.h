// Splitting a set of pieces by a plane that cuts those it meets, with the surface area heuristic.
//
// Based on: M. Stich, H. Friedrich, A. Dietrich, "Spatial Splits in Bounding Volume Hierarchies", HPG 2009.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "bvh/packed_mesh.h"
#include "bvh/piece.h"

namespace lkao::bvh {

// Slabs of equal width along each axis of a set's bounds.
class SlabMap {
 public:
  static constexpr int kBins = 16;

  explicit SlabMap(const PieceSet& set);

  bool is_flat(int axis) const { return width_[axis] == 0; }
  IntLanes bins_of(Lanes point) const {
    const IntLanes bins = __builtin_convertvector((point - origin_) * scale_, IntLanes);
    return bins < kBins - 1 ? bins : IntLanes{} + (kBins - 1);
  }
  // The plane between bin - 1 and bin.
  float plane(int bin, int axis) const { return origin_[axis] + static_cast<float>(bin) * width_[axis]; }

 private:
  Lanes origin_, scale_, width_;
};

struct SpatialSplit {
  float cost = std::numeric_limits<float>::infinity();  // as of an ObjectSplit
  int axis = 0;
  float plane = 0;
  std::size_t left_count = 0, right_count = 0;
  Box left = empty_box(), right = empty_box();
};

// As ObjectBins, for planes. Boxes of cut triangles are exact but for rounding: good enough to compare planes by, not
// to bound what is cut.
class SpatialBins {
 public:
  SpatialBins();
  void add(std::span<const Piece> pieces, const SlabMap& map, const PackedMesh& mesh);
  void merge_with(const SpatialBins& other);
  SpatialSplit best(const SlabMap& map) const;

 private:
  void add_along(int axis, const Piece& piece, int first_bin, int last_bin, const SlabMap& map,
                 const Lanes (&corners)[3]);
  void count(int axis, int first_bin, int last_bin) { ++begins_[axis][first_bin], ++ends_[axis][last_bin]; }

  Box boxes_[3][SlabMap::kBins];
  std::uint32_t begins_[3][SlabMap::kBins] = {}, ends_[3][SlabMap::kBins] = {};  // of pieces, by their bins
};

}  // namespace lkao::bvh
