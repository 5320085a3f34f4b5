#include "bvh/split_builder.h"

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include "bvh/triangle_clip.h"

namespace lkao::bvh {
namespace {

// Room for splits, as a share of the triangles.
constexpr double kRoom = 1.0;
// Planes are tried where the children's boxes overlap by such a share of the set's box.
constexpr float kOverlapOfSet = 0.1f;

constexpr std::size_t kPiecesWorthATask = 1024;
constexpr std::size_t kPiecesWorthManyTasks = 16384;
// From this level on sets are halved by number, so that no leaf is deeper than kMaxDepth: 8^16 pieces still find room.
constexpr int kLastFreeLevel = kMaxDepth - 16;

bool is_worth_a_task(const PieceSet& set) { return set.size() >= kPiecesWorthATask; }

Bounds bounds_of(const Box& box) {
  return {{box.lower[0], box.lower[1], box.lower[2]}, {box.upper[0], box.upper[1], box.upper[2]}};
}

// The bins of pieces, by as many threads as there are for large sets.
template <typename MakeEmpty, typename Add, typename Merge>
auto bin(std::span<const Piece> pieces, const MakeEmpty& make_empty, const Add& add, const Merge& merge_into) {
  auto bins = make_empty();
  if (pieces.size() < kPiecesWorthManyTasks) {
    add(bins, pieces);
    return bins;
  }
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, pieces.size(), kPiecesWorthATask * 2), bins,
      [&](const tbb::blocked_range<std::size_t>& range, auto part) {
        add(part, pieces.subspan(range.begin(), range.size()));
        return part;
      },
      [&](auto part, const auto& other) {
        merge_into(part, other);
        return part;
      });
}

// What becomes of a piece that a plane cuts.
enum class Fate { kCut, kWholeToLeft, kWholeToRight };

// By the cost of the two sides (Sec. 4.4 of the paper), whose boxes grow by what goes there whole.
Fate decide(const Box& piece, bool may_cut, SpatialSplit& split) {
  const Box left = merge(split.left, piece), right = merge(split.right, piece);
  const auto left_count = static_cast<float>(split.left_count), right_count = static_cast<float>(split.right_count);
  const float left_area = half_area(split.left), right_area = half_area(split.right);
  const float cut_cost = left_area * left_count + right_area * right_count;
  const float left_cost = half_area(left) * left_count + right_area * (right_count - 1);
  const float right_cost = left_area * (left_count - 1) + half_area(right) * right_count;
  if (may_cut && cut_cost < left_cost && cut_cost < right_cost) return Fate::kCut;
  if (left_cost <= right_cost) {
    split.left = left;
    return Fate::kWholeToLeft;
  }
  split.right = right;
  return Fate::kWholeToRight;
}

}  // namespace

std::size_t SplitBuilder::capacity_for(std::size_t triangle_count) const {
  const double room = spatial_splits_ ? kRoom * static_cast<double>(triangle_count) : 0;
  return triangle_count + static_cast<std::size_t>(room);
}

const BuildTree& SplitBuilder::build(Pieces pieces, const Progress& progress) {
  pieces_ = std::move(pieces);
  PieceSet set;
  set.end = pieces_.size();
  for (const Piece& piece : pieces_) set.include(piece);
  pieces_.resize(capacity_for(set.size()));
  set.room_end = pieces_.size();
  lut::ProgressSum sum(progress, set.size_with_room());
  const BuildTree* const tree = build_tree(set, 0, sum);
  if (!is_worth_a_task(set)) sum.add(set.size_with_room());
  return *tree;
}

template <typename Tree>
Tree* SplitBuilder::create() {
  static_assert(alignof(Tree) <= alignof(std::max_align_t) && std::is_trivially_destructible_v<Tree>);
  return new (memory_.local().allocate(sizeof(Tree))) Tree;
}

const BuildTree* SplitBuilder::build_tree(const PieceSet& set, int level, lut::ProgressSum& sum) {
  return set.size() <= kLeafWidth ? build_leaf(set) : build_node(set, level, sum);
}

const BuildTree* SplitBuilder::build_leaf(const PieceSet& set) {
  auto* leaf = create<BuildLeaf>();
  std::uint32_t* end = leaf->primitives;
  for (const Piece& piece : pieces_of(set)) {
    // Two pieces of one triangle may have come together again.
    const std::uint32_t primitive = piece.primitive();
    if (std::find(leaf->primitives, end, primitive) == end) *end++ = primitive;
  }
  leaf->size = {.leaf_count = 1, .reference_count = static_cast<std::size_t>(end - leaf->primitives)};
  return leaf;
}

const BuildTree* SplitBuilder::build_node(const PieceSet& set, int level, lut::ProgressSum& sum) {
  auto* node = create<BuildNode>();
  PieceSet children[kWidth];
  const int count = split_into_children(set, level, children);
  node->child_count = static_cast<std::uint32_t>(count);
  std::fill_n(node->children, count, nullptr);
  const auto build_child = [&](int i) {
    node->bounds[i] = bounds_of(children[i].bounds);
    node->children[i] = build_tree(children[i], level + 1, sum);
    if (is_worth_a_task(set) && !is_worth_a_task(children[i])) sum.add(children[i].size_with_room());
  };
  if (is_worth_a_task(set)) {
    tbb::parallel_for(0, count, build_child);
  } else {
    for (int i = 0; i < count; ++i) build_child(i);
  }
  // A loop of TBB that is stopped from outside, by what another branch throws, returns as if it were done.
  if (std::find(node->children, node->children + count, nullptr) != node->children + count) throw Cancelled();
  node->size = {.node_count = 1};
  for (int i = 0; i < count; ++i) node->size += node->children[i]->size;
  return node;
}

// Splits the largest child again and again.
int SplitBuilder::split_into_children(const PieceSet& set, int level, PieceSet (&children)[kWidth]) {
  int count = 1;
  children[0] = set;
  while (count < kWidth) {
    int largest = -1;
    float largest_area = -1;
    for (int i = 0; i < count; ++i) {
      if (children[i].size() <= kLeafWidth) continue;
      const float area = half_area(children[i].bounds);
      if (area > largest_area) largest = i, largest_area = area;
    }
    if (largest < 0) break;
    Halves halves = split(children[largest], level);
    children[largest] = halves.left;
    children[count++] = halves.right;
  }
  // Large walls stand alone; the traversal begins at the end, with what blocks most for the least work.
  std::stable_sort(children, children + count,
                   [](const PieceSet& a, const PieceSet& b) { return a.size() > b.size(); });
  return count;
}

Halves SplitBuilder::split(const PieceSet& set, int level) {
  if (level >= kLastFreeLevel) return split_in_middle(set);
  const CenterMap map(set);
  const ObjectSplit by_centers = find_object_split(set, map);
  if (may_gain_by_planes(set, by_centers)) {
    const SpatialSplit by_plane = find_spatial_split(set);
    const bool has_room = by_plane.left_count + by_plane.right_count <= set.size() + set.room();
    if (has_room && by_plane.cost < by_centers.cost) {
      // If all pieces go to one side, none is cut, and the set is what it was.
      const Halves halves = split_by_plane(set, by_plane);
      if (halves.are_both_filled()) return halves;
    }
  }
  const bool is_split = by_centers.cost < std::numeric_limits<float>::infinity();
  return is_split ? split_by_centers(set, map, by_centers) : split_in_middle(set);
}

Halves SplitBuilder::split_by_centers(const PieceSet& set, const CenterMap& map, const ObjectSplit& split) {
  Partition partition(pieces_, set);
  while (partition.has_next()) {
    const Piece piece = partition.next();
    if (map.is_left(piece, split.axis, split.first_right_bin)) {
      partition.put_left(piece);
    } else {
      partition.put_right(piece);
    }
  }
  return partition.finish();
}

Halves SplitBuilder::split_by_plane(const PieceSet& set, SpatialSplit split) {
  Partition partition(pieces_, set);
  while (partition.has_next()) {
    const Piece piece = partition.next();
    if (piece.box.upper[split.axis] <= split.plane) {
      partition.put_left(piece);
      continue;
    }
    if (piece.box.lower[split.axis] >= split.plane) {
      partition.put_right(piece);
      continue;
    }
    const auto [left, right] = cut_triangle(mesh_, piece.primitive(), piece.box, split.axis, split.plane);
    if (is_empty(right)) {
      partition.put_left(piece);
      continue;
    }
    if (is_empty(left)) {
      partition.put_right(piece);
      continue;
    }
    const Fate fate = decide(piece.box, partition.has_room(), split);
    if (fate == Fate::kCut) {
      partition.put_both({left, piece.primitive()}, {right, piece.primitive()});
    } else if (fate == Fate::kWholeToLeft) {
      partition.put_left(piece);
    } else {
      partition.put_right(piece);
    }
  }
  return partition.finish();
}

// Where nothing tells the pieces apart.
Halves SplitBuilder::split_in_middle(const PieceSet& set) {
  Partition partition(pieces_, set);
  const std::size_t left_count = set.size() / 2;
  for (std::size_t i = 0; i < left_count; ++i) partition.put_left(partition.next());
  while (partition.has_next()) partition.put_right(partition.next());
  return partition.finish();
}

ObjectSplit SplitBuilder::find_object_split(const PieceSet& set, const CenterMap& map) const {
  const auto add = [&](ObjectBins& bins, std::span<const Piece> pieces) { bins.add(pieces, map); };
  const auto merge_into = [&](ObjectBins& bins, const ObjectBins& other) { bins.merge_with(other, map); };
  return bin(
             pieces_of(set), [&] { return ObjectBins(map); }, add, merge_into)
      .best(map);
}

SpatialSplit SplitBuilder::find_spatial_split(const PieceSet& set) const {
  const SlabMap map(set);
  const auto add = [&](SpatialBins& bins, std::span<const Piece> pieces) { bins.add(pieces, map, mesh_); };
  const auto merge_into = [](SpatialBins& bins, const SpatialBins& other) { bins.merge_with(other); };
  return bin(
             pieces_of(set), [] { return SpatialBins(); }, add, merge_into)
      .best(map);
}

bool SplitBuilder::may_gain_by_planes(const PieceSet& set, const ObjectSplit& split) const {
  if (set.room() == 0) return false;
  const Box overlap = intersect(split.left, split.right);
  if (is_empty(overlap)) return false;
  return half_area(overlap) >= kOverlapOfSet * half_area(set.bounds);
}

}  // namespace lkao::bvh
