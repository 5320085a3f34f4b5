#include "bvh/spatial_bins.h"

#include <algorithm>
#include <utility>

#include "bvh/object_bins.h"

namespace lkao::bvh {
namespace {

// The corners of a triangle in order along an axis, and how its edges run.
struct SortedCorners {
  SortedCorners(const Lanes (&corners)[3], int axis) : low(corners[0]), middle(corners[1]), high(corners[2]) {
    if (middle[axis] < low[axis]) std::swap(low, middle);
    if (high[axis] < middle[axis]) std::swap(middle, high);
    if (middle[axis] < low[axis]) std::swap(low, middle);
    low_to_high = (high - low) / (high[axis] - low[axis]);
    low_to_middle = (middle - low) / (middle[axis] - low[axis]);
    middle_to_high = (high - middle) / (high[axis] - middle[axis]);
  }

  // Where a plane between low and high crosses two edges.
  Box crossing(float plane, int axis) const {
    const Lanes a = low + (plane - low[axis]) * low_to_high;
    const Lanes b = plane < middle[axis] ? low + (plane - low[axis]) * low_to_middle
                                         : middle + (plane - middle[axis]) * middle_to_high;
    return {min(a, b), max(a, b)};
  }

  Lanes low, middle, high;
  Lanes low_to_high, low_to_middle, middle_to_high;  // for each unit along the axis
};

Lanes lanes_of(const glm::vec3& p) { return Lanes{p.x, p.y, p.z, 0}; }

}  // namespace

SlabMap::SlabMap(const PieceSet& set) : origin_(set.bounds.lower), scale_{}, width_{} {
  constexpr float kSmallest = 1e-34f;  // its reciprocal is finite
  const Lanes extent = set.bounds.upper - set.bounds.lower;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(extent[axis] > kSmallest)) continue;
    scale_[axis] = static_cast<float>(kBins) / extent[axis];
    width_[axis] = extent[axis] / static_cast<float>(kBins);
  }
}

SpatialBins::SpatialBins() {
  for (auto& boxes : boxes_) std::fill_n(boxes, SlabMap::kBins, empty_box());
}

void SpatialBins::add(std::span<const Piece> pieces, const SlabMap& map, const PackedMesh& mesh) {
  for (const Piece& piece : pieces) {
    const IntLanes first = map.bins_of(piece.box.lower), last = map.bins_of(piece.box.upper);
    const std::uint32_t primitive = piece.primitive();
    const Lanes corners[3] = {lanes_of(mesh.corner(primitive, 0)), lanes_of(mesh.corner(primitive, 1)),
                              lanes_of(mesh.corner(primitive, 2))};
    for (int axis = 0; axis < 3; ++axis) {
      if (first[axis] == last[axis]) {
        Box& box = boxes_[axis][first[axis]];
        box = merge(box, piece.box);
        count(axis, first[axis], last[axis]);
      } else {
        add_along(axis, piece, first[axis], last[axis], map, corners);
      }
    }
  }
}

// Between two planes lies what the two cut, and the corners there.
void SpatialBins::add_along(int axis, const Piece& piece, int first_bin, int last_bin, const SlabMap& map,
                            const Lanes (&corners)[3]) {
  const SortedCorners sorted(corners, axis);
  const float low = sorted.low[axis], middle = sorted.middle[axis], high = sorted.high[axis];
  int first_met = last_bin, last_met = first_bin;
  float plane = map.plane(first_bin, axis);
  Box behind = plane > low && plane < high ? sorted.crossing(plane, axis) : Box{sorted.low, sorted.low};
  bool is_before_middle = plane <= middle;
  for (int bin = first_bin; bin <= last_bin; ++bin) {
    plane = map.plane(bin + 1, axis);
    if (plane <= low) continue;
    const Box front = plane < high ? sorted.crossing(plane, axis) : Box{sorted.high, sorted.high};
    Box slab = merge(behind, front);
    if (is_before_middle && middle <= plane) slab = merge(slab, sorted.middle), is_before_middle = false;
    behind = front;
    slab = intersect(slab, piece.box);
    if (is_empty(slab)) continue;
    boxes_[axis][bin] = merge(boxes_[axis][bin], slab);
    first_met = std::min(first_met, bin), last_met = bin;
  }
  count(axis, std::min(first_met, last_met), last_met);
}

void SpatialBins::merge_with(const SpatialBins& other) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int bin = 0; bin < SlabMap::kBins; ++bin) {
      boxes_[axis][bin] = merge(boxes_[axis][bin], other.boxes_[axis][bin]);
      begins_[axis][bin] += other.begins_[axis][bin];
      ends_[axis][bin] += other.ends_[axis][bin];
    }
  }
}

SpatialSplit SpatialBins::best(const SlabMap& map) const {
  SpatialSplit best;
  int best_bin = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (map.is_flat(axis)) continue;
    float right_costs[SlabMap::kBins];
    std::size_t right_counts[SlabMap::kBins];
    Box box = empty_box();
    std::size_t count = 0;
    for (int bin = SlabMap::kBins - 1; bin > 0; --bin) {
      box = merge(box, boxes_[axis][bin]);
      count += ends_[axis][bin];
      right_counts[bin] = count;
      right_costs[bin] = count == 0 ? best.cost : half_area(box) * leaf_cost(count);
    }
    box = empty_box();
    count = 0;
    for (int bin = 1; bin < SlabMap::kBins; ++bin) {
      box = merge(box, boxes_[axis][bin - 1]);
      count += begins_[axis][bin - 1];
      if (count == 0 || right_counts[bin] == 0) continue;
      const float cost = half_area(box) * leaf_cost(count) + right_costs[bin];
      if (!(cost < best.cost)) continue;
      best.cost = cost, best.axis = axis, best_bin = bin;
      best.left_count = count, best.right_count = right_counts[bin];
    }
  }
  best.plane = map.plane(best_bin, best.axis);
  for (int bin = 0; bin < SlabMap::kBins; ++bin) {
    Box& side = bin < best_bin ? best.left : best.right;
    side = merge(side, boxes_[best.axis][bin]);
  }
  return best;
}

}  // namespace lkao::bvh
