// Single rays through the hierarchy, many at once. Included once for each SIMD target.
#if defined(LKAO_BVH_SIMD_RAY_STREAM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_BVH_SIMD_RAY_STREAM_INL_H_
#undef LKAO_BVH_SIMD_RAY_STREAM_INL_H_
#else
#define LKAO_BVH_SIMD_RAY_STREAM_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cstdint>

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "bvh/blocker_memory.h"
#include "bvh/defined_triangle.h"
#include "bvh/layout.h"
#include "bvh/query.h"
#include "bvh/simd/box_masks-inl.h"
#include "bvh/simd/leaf_frames-inl.h"
#include "bvh/simd/ray_sets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

// Pairs of a ray and a node or leaf that it may meet. Each pair is answered by itself, one ray against 8 boxes or 4
// triangles, without a branch that depends on the answer: the processor works on many of them at a time, and neither
// waits for memory nor guesses wrong as it does when it follows one ray after the other. The pairs of a ray that was
// closed in the meantime are dropped, so leaves are answered soon.
//
// kRemembers: keeps RaySet::blockers.
template <class Parts, bool kRemembers>
class RayStream {
 public:
  RayStream(const Layout& layout, const Query& query, const LeafReceiver& receiver, RaySet& rays)
      : layout_(layout), query_(query), receiver_(receiver), rays_(rays), parts_(query), squares_(layout.grids.get()) {}

  // Adds the rays that may meet a child.
  HWY_INLINE void push(ChildRef child, const ActiveRays& active) {
    const NumberTag tag;
    const auto bits = hn::Set(tag, child.bits());
    int count = pairs_.count;
    for_each_chunk(active.chunks, [&](int chunk) {
      const std::uint32_t mask = active.masks[chunk];
      for (int lane = 0; lane < kLaneCount; lane += lane_count(tag)) {
        const auto first = hn::Set(tag, static_cast<std::uint32_t>(chunk * kLaneCount));
        const auto rays = hn::Add(hn::Load(tag, kLaneNumbers + lane), first);
        const std::uint32_t lanes = mask >> lane & ((1u << lane_count(tag)) - 1);
        hn::StoreU(bits, tag, pairs_.children + count);
        count += store_packed(tag, rays, lanes, pairs_.rays + count);
      }
    });
    pairs_.count = count;
    if (count > kWorthwhile) answer(kBatch);
  }

  // Closes the open rays that the leaf of their cell blocks.
  HWY_NOINLINE void guess(const std::uint32_t* cells, const std::uint32_t* leaf_of_cell) {
    int count = leaves_.count;
    for (int chunk = 0; chunk < rays_.chunk_count; ++chunk) {
      for (std::uint32_t rest = rays_.open[chunk]; rest != 0; rest &= rest - 1) {
        const auto ray = static_cast<std::uint32_t>(chunk * kLaneCount + std::countr_zero(rest));
        const std::uint32_t leaf = leaf_of_cell[cells[ray]];
        const bool is_known = leaf != BlockerMemory::kNone;
        prefetch(layout_.leaves.data() + (is_known ? leaf : 0));
        leaves_.children[count] = leaf;
        leaves_.rays[count] = ray;
        count += is_known;
      }
    }
    leaves_.count = count;
    visit_leaves();
  }

  // Closes all rays of the stream that some triangle blocks.
  void run() {
    answer(0);
    visit_leaves();
  }

  // Pairs so far, those of leaves and of closed rays included.
  int pair_count() const { return pair_count_; }

 private:
  // Answers nodes until no more than `most` pairs are left, and their leaves as soon as there are more than a few.
  HWY_NOINLINE void answer(int most) {
    Batch batches[2];
    int turn = 0;
    take(batches[turn]);
    while (batches[turn].count > 0 || pairs_.count > most) {
      if (pairs_.count > most) {
        take(batches[1 - turn]);
      } else {
        batches[1 - turn].count = 0;
      }
      visit_nodes(batches[turn]);
      turn = 1 - turn;
      if (leaves_.count > kFewLeaves) visit_leaves();
    }
  }

  using NumberTag = hn::CappedTag<std::uint32_t, kLaneCount>;

  static constexpr int kBatch = 32;
  // A stream this long is answered at once, and leaves as soon as there are more than a few: every ray that they close
  // spares the pairs that it has left.
  static constexpr int kWorthwhile = 96, kFewLeaves = 12;
  // push() adds no more than all rays once; a batch no more than 8 children a pair. From kFull on pairs are answered
  // one by one, depth first, and each level of the hierarchy adds at most 7.
  static constexpr int kFull = 1024;
  static constexpr int kCapacity = kFull + kMaxRayCount + 2 * kBatch * kWidth + 2 * kMaxDepth * kWidth + 4 * kLaneCount;

  struct Pairs {
    int count = 0;
    std::uint32_t children[kCapacity];
    std::uint32_t rays[kCapacity];
  };

  // Nodes on their way into the cache.
  struct Batch {
    int count = 0;
    std::uint32_t nodes[kBatch + kLaneCount];
    std::uint32_t rays[kBatch + kLaneCount];
  };

  // Moves pairs to the batch or the leaves, those of open rays.
  HWY_INLINE void take(Batch& batch) {
    const int count = pairs_.count > kFull ? 1 : std::min(kBatch, pairs_.count);
    pairs_.count -= count;
    pair_count_ += count;
    const int first_leaf = leaves_.count;
    sort_pairs(count, batch);
    for (int i = 0; i < batch.count; ++i) prefetch(layout_.nodes.data() + batch.nodes[i]);
    for (int i = first_leaf; i < leaves_.count; ++i) prefetch(layout_.leaves.data() + leaves_.children[i]);
  }

  // `count` pairs from the end of the list on, which is already that much shorter.
  HWY_INLINE void sort_pairs(int count, Batch& batch) {
    int node_count = 0, leaf_count = leaves_.count;
    const std::uint32_t* const children = pairs_.children + pairs_.count;
    const std::uint32_t* const rays = pairs_.rays + pairs_.count;
    const NumberTag tag;
    if constexpr (hn::MaxLanes(NumberTag()) >= 8) {
      const auto leaf_bit = hn::Set(tag, ChildRef::kLeafBit);
      for (int i = 0; i < count; i += lane_count(tag)) {
        const auto child = hn::LoadU(tag, children + i), ray = hn::LoadU(tag, rays + i);
        const auto valid = hn::FirstN(tag, static_cast<std::size_t>(count - i));
        const auto open = hn::And(valid, rays_.are_open(tag, ray)), is_leaf = hn::TestBit(child, leaf_bit);
        const auto leaf = hn::And(open, is_leaf), node = hn::AndNot(is_leaf, open);
        store_packed(tag, child, node, batch.nodes + node_count);
        node_count += store_packed(tag, ray, node, batch.rays + node_count);
        store_packed(tag, hn::AndNot(leaf_bit, child), leaf, leaves_.children + leaf_count);
        leaf_count += store_packed(tag, ray, leaf, leaves_.rays + leaf_count);
      }
    } else {
      for (int i = 0; i < count; ++i) {
        const std::uint32_t is_leaf = children[i] >> 31, is_open = rays_.is_open(rays[i]);
        batch.nodes[node_count] = children[i];
        batch.rays[node_count] = rays[i];
        node_count += static_cast<int>(is_open & ~is_leaf);
        leaves_.children[leaf_count] = children[i] & ~ChildRef::kLeafBit;
        leaves_.rays[leaf_count] = rays[i];
        leaf_count += static_cast<int>(is_open & is_leaf);
      }
    }
    batch.count = node_count;
    leaves_.count = leaf_count;
  }

  // A node or a leaf.
  static HWY_INLINE void prefetch(const void* item) {
    static_assert(sizeof(Node) <= 256 && sizeof(Leaf) <= 256);
    for (int offset = 0; offset < 256; offset += 64) hwy::Prefetch(static_cast<const std::uint8_t*>(item) + offset);
  }

  HWY_INLINE void visit_nodes(const Batch& batch) {
    int count = pairs_.count;
    for (int k = 0; k < batch.count; ++k) {
      count = visit_node(layout_.nodes[batch.nodes[k]], batch.rays[k], count);
    }
    pairs_.count = count;
  }

  // Adds the children that the ray may meet to the `count` pairs there are, and returns how many are then.
  HWY_INLINE int visit_node(const Node& node, std::uint32_t ray, int count) {
    const BoxTag tag;
    const hn::RebindToUnsigned<BoxTag> bits_tag;
    const float inverse[] = {rays_.inverse_x[ray], rays_.inverse_y[ray], rays_.inverse_z[ray]};
    for (int i = 0; i < kWidth; i += lane_count(tag)) {
      const auto origin = [&](std::uint32_t face, int axis) { return query_.face_origins[face][axis]; };
      const auto enter = parts_.begin_of_one(tag, ray), leave = parts_.end_of_one(tag, ray);
      const auto met = hn::RebindMask(bits_tag, children_met(node, i, inverse, origin, enter, leave));
      hn::StoreU(hn::Set(bits_tag, ray), bits_tag, pairs_.rays + count);
      count += store_packed(bits_tag, hn::Load(bits_tag, node.child_bits() + i), met, pairs_.children + count);
    }
    return count;
  }

  void visit_leaves() {
    if (HWY_UNLIKELY(receiver_.has_holes)) {
      visit_leaves<true>();
    } else {
      visit_leaves<false>();
    }
  }

  template <bool kHasHoles>
  HWY_NOINLINE void visit_leaves() {
    // A copy: for all the compiler knows, stores to the lists could change what the reference refers to.
    const LeafReceiver receiver = receiver_;
    const int count = leaves_.count;
    // The last pair again, until the last vector is full.
    for (int i = count; i < count + kLeavesAtOnce - 1 && count > 0; ++i) {
      leaves_.children[i] = leaves_.children[count - 1];
      leaves_.rays[i] = leaves_.rays[count - 1];
    }
    for (int i = 0; i < count; i += kLeavesAtOnce) visit_leaves_at<kHasHoles>(receiver, i);
    leaves_.count = 0;
  }

  template <bool kHasHoles>
  HWY_INLINE void visit_leaves_at(const LeafReceiver& receiver, int first) {
    const Leaf* leaves[kLeavesAtOnce];
    std::uint32_t rays[kLeavesAtOnce];
    for (int i = 0; i < kLeavesAtOnce; ++i) {
      leaves[i] = layout_.leaves.data() + leaves_.children[first + i];
      rays[i] = leaves_.rays[first + i];
    }
    const LeafFrames<kLeavesAtOnce, kHasHoles> frames(receiver, leaves);
    const Verdict triangles = frames.blocked(rays_, parts_, rays);
    std::uint32_t sure = triangles.sure & ~frames.holed(), clear = 0;
    if (kHasHoles && squares_.is_of_use()) {
      const KnownHoles known = frames.known_holes(squares_, rays_, rays);
      const std::uint32_t met = triangles.sure & frames.holed() & ~frames.unsure_sides();
      sure |= met & known.opaque;
      clear = met & known.clear;
    }
    const std::uint32_t in_doubt = (triangles.perhaps & ~sure & ~clear) | frames.unsure_sides();
    for (int i = 0; i < kLeavesAtOnce; ++i) {
      constexpr std::uint32_t kOneLeaf = (1u << kLeafWidth) - 1;
      std::uint32_t blocked = (sure >> (i * kLeafWidth) & kOneLeaf) != 0;
      if (HWY_UNLIKELY((in_doubt >> (i * kLeafWidth) & kOneLeaf) != 0))
        blocked = resolve(receiver, *leaves[i], rays[i], clear >> (i * kLeafWidth) & kOneLeaf);
      rays_.close(rays[i], blocked);
      if constexpr (kRemembers) rays_.blockers[blocked != 0 ? rays[i] : kMaxRayCount] = leaves_.children[first + i];
    }
  }

  // Does any triangle of the leaf block the ray? In doubt, TriangleTest decides; of those with holes, their holes.
  // It passes those that are `clear`.
  HWY_NOINLINE bool resolve(const LeafReceiver& receiver, const Leaf& leaf, std::uint32_t ray,
                            std::uint32_t clear) const {
    const Leaf* const leaves[] = {&leaf};
    const std::uint32_t rays[] = {ray};
    LeafFrames<1, true> frames(receiver, leaves);
    frames.decide_sides(receiver);
    const Verdict triangles = frames.blocked(rays_, parts_, rays);
    if ((triangles.sure & ~frames.holed()) != 0) return true;
    const std::uint32_t holed = triangles.perhaps & frames.holed() & ~clear;
    if (holed != 0 && goes_through_no_hole(leaf, ray, holed, triangles.sure)) return true;
    for (std::uint32_t rest = triangles.perhaps & ~frames.holed(); rest != 0; rest &= rest - 1) {
      const std::uint32_t primitive = leaf.primitives[std::countr_zero(rest)];
      if (DefinedTriangle(layout_, query_, primitive).blocks(static_cast<int>(ray))) return true;
    }
    return false;
  }

  // Of the triangles with holes that the ray may meet, those `sure` for sure: does any block it?
  bool goes_through_no_hole(const Leaf& leaf, std::uint32_t ray, std::uint32_t holed, std::uint32_t sure) const {
    for (holed &= (1u << leaf.triangle_count()) - 1; holed != 0; holed &= holed - 1) {
      const int i = std::countr_zero(holed);
      DefinedTriangle triangle(layout_, query_, leaf.primitives[i]);
      const bool is_sure = (sure >> i & 1) != 0;
      const int number = static_cast<int>(ray);
      if (is_sure ? triangle.blocks_met(number) : triangle.blocks(number)) return true;
    }
    return false;
  }

  const Layout& layout_;
  const Query& query_;
  const LeafReceiver& receiver_;
  RaySet& rays_;
  Parts parts_;
  HoleSquares squares_;
  int pair_count_ = 0;
  Pairs pairs_;   // children as ChildRef::bits
  Pairs leaves_;  // children as indices into layout_.leaves
};

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
