// Compiled once for every SIMD target (Highway); the fastest that the processor has is chosen at run time.
//
// Wide phase: nodes are visited with a mask of all rays, tested 16 at a time (a chunk: neighbours in the pattern). Where
// the active rays are thinly spread over their chunks they are packed densely before they go on.
// Stream: children that few rays may meet are put aside, and answered ray by ray once all of them are known.
//
// Differs from the paper (see traversal.h): masks come from box and plane tests of the rays in single precision. They
// are conservative; a ray within their rounding of a triangle's planes is decided by TriangleTest. So every target
// gives the bits of the scalar kernel, whether it fuses multiply-adds or not.
#include "bvh/simd_kernel.h"

#include <algorithm>

#include "bvh/triangle_test.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bvh/simd_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

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
#define T_LEAF 3
#endif
// A child goes to the stream if it meets no more rays than this, a leaf if it meets no more in a chunk on average.
constexpr int kFewRays = T_FEW, kFewRaysPerChunk = T_LEAF;

class SimdTraversal {
 public:
  SimdTraversal(const Layout& layout, const Query& query)
      : layout_(layout),
        query_(query),
        near_(0x1p-22f * largest_extent(layout.bounds)),
        rays_(query.rays),
        stream_(layout, query, rays_, near_) {}

  OcclusionMask run() {
    if (!layout_.nodes.empty()) {
      visit(layout_.nodes[0], rays_.all(), ActiveChunks(rays_.all(), query_.rays.ray_count / kLaneCount));
    }
    stream_.run();
    return query_.rays.cast & ~rays_.open_mask();
  }

 private:
  static float largest_extent(const Bounds& bounds) {
    const glm::vec3 size = bounds.upper - bounds.lower;
    return std::max(size.x, std::max(size.y, size.z));
  }

  // `active`: the open rays of the set that may meet the node.
  void visit(const Node& node, const RaySet& set, const ActiveChunks& active) {
    const RelativeBoxes boxes(node, query_.rays.origin);
    const int padded_count = active.padded_count();
    alignas(8) std::uint16_t met[kWidth][kMaxChunkCount];  // by child, then chunk of `active`
    int ray_counts[kWidth], order[kWidth], child_count = 0;
    for (std::uint32_t children = boxes.within_reach(query_.up, query_.radius); children != 0;
         children &= children - 1) {
      const int child = std::countr_zero(children);
      for (int i = 0; i < padded_count; i += kChunkStep) {
        for (int k = i; k < i + kChunkStep; ++k) {
          met[child][k] = static_cast<std::uint16_t>(active.masks[k] &
                                                     boxes.rays_meeting(child, set.from(active.chunks[k])));
        }
      }
      const int ray_count = ray_counts[child] = count_rays(met[child], padded_count);
      int place = child_count++;
      for (; place > 0 && ray_counts[order[place - 1]] < ray_count; --place) order[place] = order[place - 1];
      order[place] = child;
    }
    for (int i = 0; i < child_count; ++i) {
      const int child = order[i];
      if (ray_counts[child] == 0) break;
      visit(node.children[child], set, ActiveChunks(set, active, met[child]));
    }
  }

  void visit(ChildRef child, const RaySet& set, const ActiveChunks& active) {
    const int ray_count = count_rays(active.masks, active.padded_count());
    if (child.is_leaf()) {
      if (ray_count <= kFewRaysPerChunk * active.count) {
        stream_.push(child, set, active);
      } else {
        visit(layout_.leaves[child.index()], set, active);
      }
    } else if (ray_count <= kFewRays) {
      stream_.push(child, set, active);
    } else if (2 * RayPool::chunks_of(ray_count) <= active.count) {
      const RaySet packed = rays_.pack(set, active, ray_count);
      visit(layout_.nodes[child.index()], packed, ActiveChunks(packed, RayPool::chunks_of(ray_count)));
      rays_.unpack(packed, ray_count);
    } else {
      visit(layout_.nodes[child.index()], set, active);
    }
  }

  void visit(const Leaf& leaf, const RaySet& set, const ActiveChunks& active) {
    const LeafFrames frames(layout_, leaf, query_, near_);
    const LeafPlanes planes(frames);
    for (int i = 0; i < active.count; ++i) {
      const RaySet rays = set.from(active.chunks[i]);
      std::uint32_t blocked = 0, in_doubt[kLeafWidth];
      planes.test(rays, active.masks[i], blocked, in_doubt);
      if (HWY_UNLIKELY((in_doubt[0] | in_doubt[1] | in_doubt[2] | in_doubt[3]) != 0)) {
        for (int triangle = 0; triangle < kLeafWidth; ++triangle) {
          const std::uint32_t lanes = in_doubt[triangle] & ~blocked;
          if (lanes != 0) blocked |= resolve(leaf.primitives[triangle], rays, lanes);
        }
      }
      *rays.open &= static_cast<std::uint16_t>(~blocked);
    }
  }

  // The rays in doubt, one by one.
  HWY_NOINLINE std::uint32_t resolve(std::uint32_t primitive, const RaySet& rays, std::uint32_t lanes) const {
    const TriangleTest test = make_test(layout_, primitive, query_);
    std::uint32_t blocked = 0;
    for (; test.can_block() && lanes != 0; lanes &= lanes - 1) {
      const int lane = std::countr_zero(lanes);
      if (test.blocks({rays.x[lane], rays.y[lane], rays.z[lane]})) blocked |= 1u << lane;
    }
    return blocked;
  }

  const Layout& layout_;
  const Query& query_;
  float near_;
  RayPool rays_;
  RayStream stream_;
};

OcclusionMask trace_simd(const Layout& layout, const Query& query) { return SimdTraversal(layout, query).run(); }

}  // namespace
}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lkao::bvh {

HWY_EXPORT(trace_simd);

OcclusionMask trace_simd(const Layout& layout, const Query& query) {
  return HWY_DYNAMIC_DISPATCH(trace_simd)(layout, query);
}

}  // namespace lkao::bvh
#endif
