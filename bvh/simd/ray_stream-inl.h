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
template <class Parts>
class RayStream {
 public:
  RayStream(const Layout& layout, const Query& query, const LeafReceiver& receiver, RaySet& rays)
      : layout_(layout), query_(query), receiver_(receiver), rays_(rays), parts_(query) {}

  // Adds the rays that may meet a child.
  HWY_INLINE void push(ChildRef child, const ActiveRays& active) {
    const hn::CappedTag<std::uint32_t, kLaneCount> tag;
    const auto bits = hn::Set(tag, child.bits());
    int count = pairs_.count;
    for_each_chunk(active.chunks, [&](int chunk) {
      std::uint32_t mask = active.masks[chunk];
      auto rays = hn::Iota(tag, static_cast<std::uint32_t>(chunk * kLaneCount));
      for (int lane = 0; lane < kLaneCount; lane += lane_count(tag)) {
        const std::uint32_t lanes = mask & ((1u << lane_count(tag)) - 1);
        hn::StoreU(hn::Compress(rays, mask_of(tag, lanes)), tag, pairs_.rays + count);
        hn::StoreU(bits, tag, pairs_.children + count);
        count += std::popcount(lanes);
        mask >>= lane_count(tag);
        rays = hn::Add(rays, hn::Set(tag, static_cast<std::uint32_t>(lane_count(tag))));
      }
    });
    pairs_.count = count;
    if (count > kFull) run();
  }

  // Closes all rays of the stream that some triangle blocks.
  HWY_NOINLINE void run() {
    Batch batches[2];
    int turn = 0;
    take(batches[turn]);
    while (batches[turn].count > 0 || pairs_.count > 0) {
      take(batches[1 - turn]);
      visit_nodes(batches[turn]);
      turn = 1 - turn;
      if (leaves_.count > kFull) visit_leaves();
    }
    visit_leaves();
  }

 private:
  static constexpr int kBatch = 24;
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

  // Moves pairs to the batch or the leaves, those of open rays.
  HWY_INLINE void take(Batch& batch) {
    const int count = pairs_.count > kFull ? 1 : std::min(kBatch, pairs_.count);
    pairs_.count -= count;
    const Node* const nodes = layout_.nodes.data();
    const Leaf* const leaves = layout_.leaves.data();
    int node_count = 0, leaf_count = leaves_.count;
    for (int i = pairs_.count; i < pairs_.count + count; ++i) {
      const std::uint32_t bits = pairs_.children[i], ray = pairs_.rays[i];
      const std::uint32_t index = bits & ~ChildRef::kLeafBit, is_leaf = bits >> 31, is_open = rays_.is_open(ray);
      prefetch(is_leaf != 0 ? static_cast<const void*>(leaves + index) : nodes + index);
      batch.nodes[node_count] = index;
      batch.rays[node_count] = ray;
      node_count += static_cast<int>(is_open & ~is_leaf);
      leaves_.children[leaf_count] = index;
      leaves_.rays[leaf_count] = ray;
      leaf_count += static_cast<int>(is_open & is_leaf);
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
    const BoxTag tag;
    const hn::RebindToUnsigned<BoxTag> bits_tag;
    const Node* const nodes = layout_.nodes.data();
    const glm::vec3 origin = query_.rays.origin;
    const auto ox = hn::Set(tag, origin.x), oy = hn::Set(tag, origin.y), oz = hn::Set(tag, origin.z);
    int count = pairs_.count;
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
        const auto enter =
            hn::Max(hn::Max(hn::Min(x0, x1), hn::Min(y0, y1)), hn::Max(hn::Min(z0, z1), parts_.begin_of_one(tag, ray)));
        const auto leave =
            hn::Min(hn::Min(hn::Max(x0, x1), hn::Max(y0, y1)), hn::Min(hn::Max(z0, z1), parts_.end_of_one(tag, ray)));
        const auto met = hn::RebindMask(bits_tag, hn::Le(enter, hn::Mul(leave, hn::Set(tag, 1.0f + kBoxSlack))));
        const auto children = hn::Load(bits_tag, node.child_bits() + i);
        hn::StoreU(hn::Compress(children, met), bits_tag, pairs_.children + count);
        hn::StoreU(hn::Set(bits_tag, ray), bits_tag, pairs_.rays + count);
        count += static_cast<int>(hn::CountTrue(bits_tag, met));
      }
    }
    pairs_.count = count;
  }

  HWY_INLINE void visit_leaves() {
    const LeafReceiver receiver = receiver_;
    const Leaf* const leaves = layout_.leaves.data();
    const int count = leaves_.count;
    for (int i = 0; i < count; ++i) visit(receiver, leaves[leaves_.children[i]], leaves_.rays[i]);
    leaves_.count = 0;
  }

  HWY_INLINE void visit(const LeafReceiver& receiver, const Leaf& leaf, std::uint32_t ray) {
    const LeafFrames frames(receiver, leaf);
    const Verdict triangles = frames.blocked(rays_.x[ray], rays_.y[ray], rays_.z[ray], parts_, ray);
    std::uint32_t blocked = triangles.sure != 0;
    const std::uint32_t in_doubt = static_cast<std::uint32_t>(triangles.perhaps != 0) & ~blocked;
    if (HWY_UNLIKELY(in_doubt != 0)) blocked = resolve(leaf, ray, triangles.perhaps);
    rays_.close(ray, blocked);
  }

  // Does any of the triangles in doubt block the ray?
  HWY_NOINLINE bool resolve(const Leaf& leaf, std::uint32_t ray, std::uint32_t triangles) const {
    for (; triangles != 0; triangles &= triangles - 1) {
      const TriangleTest test = make_test(layout_, leaf.primitives[std::countr_zero(triangles)], query_);
      if (test.can_block() && blocks(test, query_, static_cast<int>(ray))) return true;
    }
    return false;
  }

  const Layout& layout_;
  const Query& query_;
  const LeafReceiver& receiver_;
  RaySet& rays_;
  Parts parts_;
  Pairs pairs_;   // children as ChildRef::bits
  Pairs leaves_;  // children as indices into layout_.leaves
};

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
