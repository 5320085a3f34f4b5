// Single rays through the hierarchy, many at once. Included once for each SIMD target.
#if defined(LKAO_BVH_SIMD_RAY_STREAM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_BVH_SIMD_RAY_STREAM_INL_H_
#undef LKAO_BVH_SIMD_RAY_STREAM_INL_H_
#else
#define LKAO_BVH_SIMD_RAY_STREAM_INL_H_
#endif

#include <algorithm>
#include <cstdint>

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "bvh/box_test.h"
#include "bvh/layout.h"
#include "bvh/simd/leaf_frames-inl.h"
#include "bvh/simd/ray_sets-inl.h"
#include "bvh/traversal.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

// Pairs of a ray and a node or leaf that it may meet. Each pair is answered by itself, one ray against 8 boxes or 4
// triangles, without a branch that depends on the answer: the processor works on many of them at a time, and neither
// waits for memory nor guesses wrong as it does when it follows one ray after the other.
class RayStream {
 public:
  RayStream(const Layout& layout, const Query& query, const LeafReceiver& receiver, RaySet& rays)
      : layout_(layout), query_(query), receiver_(receiver), rays_(rays) {}

  // Adds the rays that may meet a child.
  HWY_INLINE void push(ChildRef child, const ActiveRays& active) {
    const hn::CappedTag<std::uint32_t, kLaneCount> tag;
    Pairs& pairs = child.is_leaf() ? leaves_ : nodes_;
    const auto index = hn::Set(tag, child.index());
    int count = pairs.count;
    for_each_chunk(active.chunks, [&](int chunk) {
      std::uint32_t mask = active.masks[chunk];
      auto rays = hn::Iota(tag, static_cast<std::uint32_t>(chunk * kLaneCount));
      for (int lane = 0; lane < kLaneCount; lane += lane_count(tag)) {
        const std::uint32_t lanes = mask & ((1u << lane_count(tag)) - 1);
        hn::StoreU(hn::Compress(rays, mask_of(tag, lanes)), tag, pairs.rays + count);
        hn::StoreU(index, tag, pairs.children + count);
        count += std::popcount(lanes);
        mask >>= lane_count(tag);
        rays = hn::Add(rays, hn::Set(tag, static_cast<std::uint32_t>(lane_count(tag))));
      }
    });
    pairs.count = count;
    if (count > kFull) run();
  }

  // Closes all rays of the stream that some triangle blocks.
  HWY_NOINLINE void run() {
    Batch batches[2];
    int turn = 0;
    take(batches[turn]);
    while (batches[turn].count > 0 || nodes_.count > 0) {
      take(batches[1 - turn]);
      visit_nodes(batches[turn]);
      turn = 1 - turn;
      if (leaves_.count > kFull) visit_leaves();
    }
    visit_leaves();
  }

 private:
  static constexpr int kBatch = 16;
  // push() adds no more than all rays once; a batch no more than 8 children a pair. From kFull on pairs are answered
  // one by one, depth first, and each level of the hierarchy adds at most 7.
  static constexpr int kFull = 1024;
  static constexpr int kCapacity = kFull + kMaxRayCount + 2 * kBatch * kWidth + 2 * kMaxDepth * kWidth + 2 * kLaneCount;

  struct Pairs {
    int count = 0;
    std::uint32_t children[kCapacity];
    std::uint32_t rays[kCapacity];
  };

  // Nodes on their way into the cache.
  struct Batch {
    int count = 0;
    std::uint32_t nodes[kBatch];
    std::uint32_t rays[kBatch];
  };

  // Moves pairs to the batch, those of open rays.
  HWY_INLINE void take(Batch& batch) {
    const int count = nodes_.count > kFull ? 1 : std::min(kBatch, nodes_.count);
    nodes_.count -= count;
    batch.count = 0;
    for (int i = nodes_.count; i < nodes_.count + count; ++i) {
      const std::uint32_t node = nodes_.children[i], ray = nodes_.rays[i];
      batch.nodes[batch.count] = node;
      batch.rays[batch.count] = ray;
      batch.count += rays_.is_open(ray);
      prefetch(layout_.nodes[node]);
    }
  }

  template <typename T>
  static HWY_INLINE void prefetch(const T& item) {
    for (std::size_t offset = 0; offset < sizeof(T); offset += 64) {
      hwy::Prefetch(reinterpret_cast<const std::uint8_t*>(&item) + offset);
    }
  }

  HWY_INLINE void visit_nodes(const Batch& batch) {
    const BoxTag tag;
    const hn::RebindToUnsigned<BoxTag> bits_tag;
    const hn::RebindToSigned<BoxTag> signed_tag;
    const Node* const nodes = layout_.nodes.data();
    const glm::vec3 origin = query_.rays.origin;
    const auto ox = hn::Set(tag, origin.x), oy = hn::Set(tag, origin.y), oz = hn::Set(tag, origin.z);
    int node_count = nodes_.count, leaf_count = leaves_.count;
    for (int k = 0; k < batch.count; ++k) {
      const Node& node = nodes[batch.nodes[k]];
      const std::uint32_t ray = batch.rays[k];
      const auto x = hn::Set(tag, rays_.inverse_x[ray]), y = hn::Set(tag, rays_.inverse_y[ray]),
                 z = hn::Set(tag, rays_.inverse_z[ray]);
      // The slab test of may_meet.
      for (int i = 0; i < kWidth; i += lane_count(tag)) {
        const auto at = [&](int face, int axis, auto from, auto inverse) {
          return hn::Mul(hn::Sub(hn::Load(tag, node.faces[face][axis] + i), from), inverse);
        };
        const auto x0 = at(0, 0, ox, x), x1 = at(1, 0, ox, x), y0 = at(0, 1, oy, y), y1 = at(1, 1, oy, y),
                   z0 = at(0, 2, oz, z), z1 = at(1, 2, oz, z);
        const auto enter = hn::Max(hn::Max(hn::Min(x0, x1), hn::Min(y0, y1)), hn::Max(hn::Min(z0, z1), hn::Zero(tag)));
        const auto leave =
            hn::Min(hn::Min(hn::Max(x0, x1), hn::Max(y0, y1)), hn::Min(hn::Max(z0, z1), hn::Set(tag, 1.0f)));
        const auto met = hn::RebindMask(bits_tag, hn::Le(enter, hn::Mul(leave, hn::Set(tag, kBoxSlack))));
        const auto children = hn::Load(bits_tag, node.child_bits() + i);
        const auto is_leaf = hn::RebindMask(bits_tag, hn::Lt(hn::BitCast(signed_tag, children), hn::Zero(signed_tag)));
        const auto leaves = hn::Xor(children, hn::Set(bits_tag, ChildRef::kLeafBit));
        leaf_count = append(leaves_, leaf_count, leaves, hn::And(met, is_leaf), ray);
        node_count = append(nodes_, node_count, children, hn::AndNot(is_leaf, met), ray);
      }
    }
    nodes_.count = node_count;
    leaves_.count = leaf_count;
  }

  template <class V, class M>
  static HWY_INLINE int append(Pairs& pairs, int count, V children, M mask, std::uint32_t ray) {
    const hn::RebindToUnsigned<BoxTag> tag;
    hn::StoreU(hn::Compress(children, mask), tag, pairs.children + count);
    hn::StoreU(hn::Set(tag, ray), tag, pairs.rays + count);
    return count + static_cast<int>(hn::CountTrue(tag, mask));
  }

  HWY_INLINE void visit_leaves() {
    constexpr int kAhead = 8;
    const LeafReceiver receiver = receiver_;
    const Leaf* const leaves = layout_.leaves.data();
    const int count = leaves_.count;
    for (int i = 0; i < std::min(kAhead, count); ++i) prefetch(leaves[leaves_.children[i]]);
    for (int i = 0; i < count; ++i) {
      const std::uint32_t ray = leaves_.rays[i];
      prefetch(leaves[leaves_.children[std::min(i + kAhead, count - 1)]]);
      visit(receiver, leaves[leaves_.children[i]], ray);
    }
    leaves_.count = 0;
  }

  HWY_INLINE void visit(const LeafReceiver& receiver, const Leaf& leaf, std::uint32_t ray) {
    const LeafFrames frames(receiver, leaf);
    const Verdict triangles = frames.blocked(rays_.x[ray], rays_.y[ray], rays_.z[ray]);
    std::uint32_t blocked = triangles.sure != 0;
    const std::uint32_t in_doubt = static_cast<std::uint32_t>(triangles.perhaps != 0) & ~blocked;
    if (HWY_UNLIKELY(in_doubt != 0)) blocked = resolve(leaf, ray, triangles.perhaps);
    rays_.close(ray, blocked);
  }

  // Does any of the triangles in doubt block the ray?
  HWY_NOINLINE bool resolve(const Leaf& leaf, std::uint32_t ray, std::uint32_t triangles) const {
    for (; triangles != 0; triangles &= triangles - 1) {
      const TriangleTest test = make_test(layout_, leaf.primitives[std::countr_zero(triangles)], query_);
      if (test.can_block() && test.blocks(query_.rays.ray(static_cast<int>(ray)))) return true;
    }
    return false;
  }

  const Layout& layout_;
  const Query& query_;
  const LeafReceiver& receiver_;
  RaySet& rays_;
  Pairs nodes_;   // indices into layout_.nodes
  Pairs leaves_;  // into layout_.leaves
};

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
