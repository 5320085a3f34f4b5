#include "bvh/object_bins.h"

#include <algorithm>

namespace lkao::bvh {

// Few pieces need few bins.
CenterMap::CenterMap(const PieceSet& set)
    : origin_(set.centers.lower),
      scale_{},
      bin_count_(static_cast<int>(std::min<std::size_t>(kMaxBins, 8 + set.size() / 8))) {
  constexpr float kSmallest = 1e-34f;  // its reciprocal is finite
  const Lanes extent = set.centers.upper - set.centers.lower;
  for (int axis = 0; axis < 3; ++axis) {
    // A little less than the count: rounding may not make a bin more.
    if (extent[axis] > kSmallest) scale_[axis] = 0.9999f * static_cast<float>(bin_count_) / extent[axis];
  }
}

ObjectBins::ObjectBins(const CenterMap& map) {
  for (int axis = 0; axis < 3; ++axis) {
    std::fill_n(boxes_[axis], map.bin_count(), empty_box());
    std::fill_n(counts_[axis], map.bin_count(), 0u);
  }
}

void ObjectBins::add(std::span<const Piece> pieces, const CenterMap& map) {
  for (const Piece& piece : pieces) {
    const IntLanes bins = map.bins_of(piece);
    for (int axis = 0; axis < 3; ++axis) {
      Box& box = boxes_[axis][bins[axis]];
      box = merge(box, piece.box);
      ++counts_[axis][bins[axis]];
    }
  }
}

void ObjectBins::merge_with(const ObjectBins& other, const CenterMap& map) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int bin = 0; bin < map.bin_count(); ++bin) {
      boxes_[axis][bin] = merge(boxes_[axis][bin], other.boxes_[axis][bin]);
      counts_[axis][bin] += other.counts_[axis][bin];
    }
  }
}

ObjectSplit ObjectBins::best(const CenterMap& map) const {
  ObjectSplit best;
  for (int axis = 0; axis < 3; ++axis) {
    if (map.is_flat(axis)) continue;
    float right_costs[CenterMap::kMaxBins];
    Box box = empty_box();
    std::size_t count = 0;
    for (int bin = map.bin_count() - 1; bin > 0; --bin) {
      box = merge(box, boxes_[axis][bin]);
      count += counts_[axis][bin];
      right_costs[bin] = count == 0 ? best.cost : half_area(box) * leaf_cost(count);
    }
    box = empty_box();
    count = 0;
    for (int bin = 1; bin < map.bin_count(); ++bin) {
      box = merge(box, boxes_[axis][bin - 1]);
      count += counts_[axis][bin - 1];
      if (count == 0) continue;
      const float cost = half_area(box) * leaf_cost(count) + right_costs[bin];
      if (cost < best.cost) best.cost = cost, best.axis = axis, best.first_right_bin = bin;
    }
  }
  for (int bin = 0; bin < map.bin_count(); ++bin) {
    Box& side = bin < best.first_right_bin ? best.left : best.right;
    side = merge(side, boxes_[best.axis][bin]);
  }
  return best;
}

}  // namespace lkao::bvh
