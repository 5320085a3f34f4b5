// Compiled once for every SIMD target (Highway); the fastest that the processor has is chosen at run time.
//
// Wide phase: nodes are visited with a mask of all rays, tested 16 at a time (a chunk: neighbours in the pattern).
// Stream: children that few rays may meet are put aside, and answered ray by ray once all of them are known.
//
// Differs from the paper (see traversal.h): masks come from box and plane tests of the rays in single precision. They
// are conservative; a ray within their rounding of a triangle's planes is decided by TriangleTest. So every target
// gives the bits of the scalar kernel, whether it fuses multiply-adds or not.
#include "bvh/simd_kernel.h"

#include <algorithm>
#include <bit>

#include "bvh/scalar_kernel.h"
#include "bvh/triangle_test.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bvh/simd_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#if HWY_TARGET == HWY_SCALAR  // no vectors, nothing to gain

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {
namespace {

OcclusionMask trace_simd(const Layout& layout, const Query& query, const PatternCones&) {
  return trace_scalar(layout, query);
}

}  // namespace
}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#else

#include "bvh/simd/box_masks-inl.h"
#include "bvh/simd/chunk_cones-inl.h"
#include "bvh/simd/leaf_frames-inl.h"
#include "bvh/simd/ray_sets-inl.h"
#include "bvh/simd/ray_stream-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {
namespace {

// A node goes to the stream if it meets no more rays than this, a leaf if it meets no more in a chunk on average.
constexpr int kFewRays = 16, kFewRaysPerChunk = 1;

template <class Parts>
class SimdTraversal {
 public:
  SimdTraversal(const Layout& layout, const Query& query, const PatternCones& cones)
      : layout_(layout),
        query_(query),
        receiver_(layout, query),
        rays_(query),
        parts_(query),
        cones_(cones, query.rays.frame, query.rays.ray_count / kLaneCount, query.near(), query.far()),
        stream_(layout, query, receiver_, rays_) {}

  OcclusionMask run() {
    const std::uint64_t all_chunks = ~std::uint64_t{0} >> (kMaxChunkCount - rays_.chunk_count);
    visit(query_.root, {all_chunks, rays_.open});
    stream_.run();
    return query_.open & ~rays_.open_mask();
  }

 private:
  // `active`: rays that may meet the node. Those that were blocked in the meantime are left out here.
  void visit(const Node& node, const ActiveRays& active) {
    const RelativeBoxes<Parts> boxes(node, query_.rays.origin, query_.rays.up, query_.near(), query_.far());
    std::uint16_t met[kWidth][kMaxChunkCount];  // by child, then chunk
    std::uint64_t met_chunks[kWidth];
    int ray_counts[kWidth];
    std::uint32_t met_children = 0;
    for (std::uint32_t children = boxes.reached(); children != 0; children &= children - 1) {
      const int child = std::countr_zero(children);
      int ray_count = 0;
      std::uint64_t chunks = 0;
      for_each_chunk(active.chunks & cones_.meeting(boxes, child), [&](int chunk) {
        const std::uint32_t candidates = static_cast<std::uint32_t>(active.masks[chunk]) & rays_.open[chunk];
        const std::uint32_t mask = candidates & boxes.rays_meeting(child, rays_, parts_, chunk);
        met[child][chunk] = static_cast<std::uint16_t>(mask);
        chunks |= static_cast<std::uint64_t>(mask != 0) << chunk;
        ray_count += std::popcount(mask);
      });
      met_chunks[child] = chunks;
      ray_counts[child] = ray_count;
      met_children |= static_cast<std::uint32_t>(chunks != 0) << child;
    }
    for (; met_children != 0; met_children &= met_children - 1) {
      const int child = std::countr_zero(met_children);
      visit(node.children[child], {met_chunks[child], met[child]}, ray_counts[child]);
    }
  }

  void visit(ChildRef child, const ActiveRays& active, int ray_count) {
    const int few = child.is_leaf() ? kFewRaysPerChunk * std::popcount(active.chunks) : kFewRays;
    if (ray_count <= few) {
      stream_.push(child, active);
    } else if (child.is_leaf()) {
      visit(layout_.leaves[child.index()], active);
    } else {
      visit(layout_.nodes[child.index()], active);
    }
  }

  void visit(const Leaf& leaf, const ActiveRays& active) {
    const LeafFrames frames(receiver_, leaf);
    const LeafPlanes planes(frames);
    for_each_chunk(active.chunks, [&](int chunk) {
      const std::uint32_t mask = active.masks[chunk];
      const Verdict rays = planes.blocked(rays_, parts_, chunk);
      std::uint32_t blocked = rays.sure;
      const std::uint32_t in_doubt = rays.perhaps & ~rays.sure & mask;
      if (HWY_UNLIKELY(in_doubt != 0)) blocked |= resolve(leaf, chunk, in_doubt);
      rays_.open[chunk] &= static_cast<std::uint16_t>(~(blocked & mask));
    });
  }

  // The rays in doubt, one by one.
  HWY_NOINLINE std::uint32_t resolve(const Leaf& leaf, int chunk, std::uint32_t lanes) const {
    std::uint32_t blocked = 0;
    for (int triangle = 0; triangle < leaf.triangle_count(); ++triangle) {
      if (leaf.primitives[triangle] == query_.excluded_primitive) continue;
      const TriangleTest test = make_test(layout_, leaf.primitives[triangle], query_);
      for (std::uint32_t rest = test.can_block() ? lanes : 0; rest != 0; rest &= rest - 1) {
        const int lane = std::countr_zero(rest);
        if (blocks(test, query_, chunk * kLaneCount + lane)) blocked |= 1u << lane;
      }
    }
    return blocked;
  }

  const Layout& layout_;
  const Query& query_;
  LeafReceiver receiver_;
  RaySet rays_;
  Parts parts_;
  ChunkCones cones_;
  RayStream<Parts> stream_;
};

OcclusionMask trace_simd(const Layout& layout, const Query& query, const PatternCones& cones) {
  if (query.parts != nullptr) return SimdTraversal<PartsOfRays>(layout, query, cones).run();
  return SimdTraversal<WholeRays>(layout, query, cones).run();
}

}  // namespace
}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

#if HWY_ONCE
namespace lkao::bvh {

HWY_EXPORT(trace_simd);

OcclusionMask trace_simd(const Layout& layout, const Query& query, const PatternCones& cones) {
  return HWY_DYNAMIC_DISPATCH(trace_simd)(layout, query, cones);
}

}  // namespace lkao::bvh
#endif
