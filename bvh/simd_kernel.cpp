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

OcclusionMask trace_simd(const Layout& layout, const Query& query) { return trace_scalar(layout, query); }

}  // namespace
}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#else

#include "bvh/simd/box_masks-inl.h"
#include "bvh/simd/leaf_frames-inl.h"
#include "bvh/simd/ray_sets-inl.h"
#include "bvh/simd/ray_stream-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {
namespace {

#ifndef T_FEW
#define T_FEW 16
#endif
#ifndef T_LEAF
#define T_LEAF 1
#endif
// A child goes to the stream if it meets no more rays than this, a leaf if it meets no more in a chunk on average.
constexpr int kFewRays = T_FEW, kFewRaysPerChunk = T_LEAF;

class SimdTraversal {
 public:
  SimdTraversal(const Layout& layout, const Query& query)
      : layout_(layout),
        query_(query),
        receiver_(layout, query),
        rays_(query.rays),
        stream_(layout, query, receiver_, rays_) {}

  OcclusionMask run() {
    visit(query_.root, ActiveChunks(rays_));
    stream_.run();
    return query_.rays.cast & ~rays_.open_mask();
  }

 private:
  // `active`: the open rays that may meet the node.
  void visit(const Node& node, const ActiveChunks& active) {
    const RelativeBoxes boxes(node, query_.rays.origin, query_.rays.up, query_.radius);
    const int padded_count = active.padded_count();
    std::uint16_t met[kWidth][kMaxChunkCount];  // by child, then chunk of `active`
    std::uint32_t met_children = 0;
    for (std::uint32_t children = boxes.reached(); children != 0; children &= children - 1) {
      const int child = std::countr_zero(children);
      std::uint32_t any = 0;
      for (int i = 0; i < padded_count; i += kChunkStep) {
        for (int k = i; k < i + kChunkStep; ++k) {
          const std::uint32_t mask = active.masks[k] & boxes.rays_meeting(child, rays_, active.chunks[k]);
          met[child][k] = static_cast<std::uint16_t>(mask);
          any |= mask;
        }
      }
      met_children |= (any != 0 ? 1u : 0u) << child;
    }
    for (std::uint32_t children = met_children; children != 0; children &= children - 1) {
      const int child = std::countr_zero(children);
      visit(node.children[child], ActiveChunks(rays_, active, met[child]));
    }
  }

  void visit(ChildRef child, const ActiveChunks& active) {
    const int few = child.is_leaf() ? kFewRaysPerChunk * active.count : kFewRays;
    if (active.ray_count <= few) {
      stream_.push(child, active);
    } else if (child.is_leaf()) {
      visit(layout_.leaves[child.index()], active);
    } else {
      visit(layout_.nodes[child.index()], active);
    }
  }

  void visit(const Leaf& leaf, const ActiveChunks& active) {
    const LeafFrames frames(receiver_, leaf);
    const LeafPlanes planes(frames);
    for (int i = 0; i < active.count; ++i) {
      const int chunk = active.chunks[i];
      const Verdict rays = planes.blocked(rays_, chunk);
      std::uint32_t blocked = rays.sure;
      const std::uint32_t in_doubt = rays.perhaps & ~rays.sure & active.masks[i];
      if (HWY_UNLIKELY(in_doubt != 0)) blocked |= resolve(leaf, chunk, in_doubt);
      rays_.open[chunk] &= static_cast<std::uint16_t>(~(blocked & active.masks[i]));
    }
  }

  // The rays in doubt, one by one.
  HWY_NOINLINE std::uint32_t resolve(const Leaf& leaf, int chunk, std::uint32_t lanes) const {
    std::uint32_t blocked = 0;
    for (int triangle = 0; triangle < leaf.triangle_count(); ++triangle) {
      if (leaf.primitives[triangle] == query_.excluded_primitive) continue;
      const TriangleTest test = make_test(layout_, leaf.primitives[triangle], query_);
      for (std::uint32_t rest = test.can_block() ? lanes : 0; rest != 0; rest &= rest - 1) {
        const int lane = std::countr_zero(rest);
        if (test.blocks(query_.rays.ray(chunk * kLaneCount + lane))) blocked |= 1u << lane;
      }
    }
    return blocked;
  }

  const Layout& layout_;
  const Query& query_;
  LeafReceiver receiver_;
  RaySet rays_;
  RayStream stream_;
};

OcclusionMask trace_simd(const Layout& layout, const Query& query) { return SimdTraversal(layout, query).run(); }

}  // namespace
}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

#if HWY_ONCE
namespace lkao::bvh {

HWY_EXPORT(trace_simd);

OcclusionMask trace_simd(const Layout& layout, const Query& query) {
  return HWY_DYNAMIC_DISPATCH(trace_simd)(layout, query);
}

}  // namespace lkao::bvh
#endif
