// Leaves that many rays may meet, 16 at a time. Included once for each SIMD target.
#if defined(LKAO_BVH_SIMD_WIDE_LEAVES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_BVH_SIMD_WIDE_LEAVES_INL_H_
#undef LKAO_BVH_SIMD_WIDE_LEAVES_INL_H_
#else
#define LKAO_BVH_SIMD_WIDE_LEAVES_INL_H_
#endif

#include <bit>
#include <cstdint>

#include <hwy/highway.h>

#include "bvh/defined_triangle.h"
#include "bvh/layout.h"
#include "bvh/pattern_cones.h"
#include "bvh/query.h"
#include "bvh/simd/chunk_cones-inl.h"
#include "bvh/simd/holed_leaf-inl.h"
#include "bvh/simd/leaf_frames-inl.h"
#include "bvh/simd/leaf_planes-inl.h"
#include "bvh/simd/ray_sets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

// Each triangle against all rays of a chunk at once; those in doubt are decided by the definition. kRemembers: rays
// keep the leaf that blocked them.
template <class Parts, bool kRemembers>
class WideLeaves {
 public:
  // `cones`: of the rays' chunks, or null. Must not outlive any of it.
  WideLeaves(const Layout& layout, const Query& query, const PatternCones& pattern_cones, const LeafReceiver& receiver,
             RaySet& rays, const Parts& parts, const ChunkCones* cones)
      : layout_(layout),
        query_(query),
        pattern_cones_(pattern_cones),
        receiver_(receiver),
        rays_(rays),
        parts_(parts),
        cones_(cones) {}

  // Returns how many of the rays it blocks, where that is to be remembered.
  int visit(const Leaf& leaf, const ActiveRays& active) {
    return HWY_UNLIKELY(receiver_.has_holes) ? visit_leaf<true>(leaf, active) : visit_leaf<false>(leaf, active);
  }

 private:
  // A leaf that so many chunks meet is answered triangle by triangle, each with the chunks whose cones meet it.
  static constexpr int kChunksWorthCones = 10;

  template <bool kHasHoles>
  int visit_leaf(const Leaf& leaf, const ActiveRays& active) {
    const Leaf* const leaves[] = {&leaf};
    LeafFrames<1, kHasHoles> frames(receiver_, leaves);
    frames.decide_sides(receiver_);
    const std::uint32_t reached = frames.reached(query_.far(), query_.rays.frame[2], pattern_cones_);
    if (reached == 0) return 0;
    const LeafPlanes planes(frames, query_.radius, reached);
    const std::uint32_t holed = kHasHoles ? reached & frames.holed() & ((1u << leaf.triangle_count()) - 1) : 0;
    int blocked_count = 0;
    const bool use_cones = std::popcount(active.chunks) >= kChunksWorthCones && cones_ != nullptr;
    if (!use_cones && std::popcount(reached) > 2 && holed == 0) {
      for_each_chunk(active.chunks, [&](int chunk) {
        blocked_count += close(leaf, planes, chunk, active.masks[chunk], planes.blocked(rays_, parts_, chunk));
      });
      return blocked_count;
    }
    for (std::uint32_t triangles = reached & ~frames.holed(); triangles != 0; triangles &= triangles - 1) {
      const int triangle = std::countr_zero(triangles);
      std::uint64_t chunks = active.chunks;
      if (use_cones) chunks &= planes.chunks_meeting(triangle, *cones_, query_.radius);
      for_each_chunk(chunks, [&](int chunk) {
        const Verdict verdict = planes.blocked(triangle, rays_, parts_, chunk);
        blocked_count += close(leaf, planes, chunk, active.masks[chunk], verdict);
      });
    }
    // What whole triangles block asks nothing.
    if constexpr (kHasHoles) blocked_count += visit_holed(leaf, planes, holed, active, use_cones);
    return blocked_count;
  }

  int visit_holed(const Leaf& leaf, const LeafPlanes& planes, std::uint32_t triangles, const ActiveRays& active,
                  bool use_cones) {
    int blocked_count = 0;
    for (; triangles != 0; triangles &= triangles - 1) {
      const int triangle = std::countr_zero(triangles);
      HoledPlanes holed(layout_, query_, planes, triangle, leaf.primitives[triangle]);
      std::uint64_t chunks = active.chunks;
      if (use_cones) chunks &= planes.chunks_meeting(triangle, *cones_, query_.radius);
      for_each_chunk(chunks, [&](int chunk) {
        const std::uint32_t open = active.masks[chunk] & rays_.open[chunk];
        if (open != 0) blocked_count += close(leaf, chunk, holed.blocked(rays_, parts_, chunk, open));
      });
    }
    return blocked_count;
  }

  // Closes those rays of `mask` that are blocked, and returns their number where that is to be remembered.
  HWY_INLINE int close(const Leaf& leaf, const LeafPlanes& planes, int chunk, std::uint32_t mask,
                       const Verdict& verdict) {
    std::uint32_t blocked = verdict.sure & mask;
    const std::uint32_t in_doubt = verdict.perhaps & ~verdict.sure & mask;
    if (HWY_UNLIKELY(in_doubt != 0)) blocked |= resolve(leaf, planes, chunk, in_doubt);
    return close(leaf, chunk, blocked);
  }

  HWY_INLINE int close(const Leaf& leaf, int chunk, std::uint32_t blocked) {
    int count = 0;
    if constexpr (kRemembers) {
      const std::uint32_t closed = blocked & rays_.open[chunk];
      count = std::popcount(closed);
      rays_.set_blocker(chunk, closed, static_cast<std::uint32_t>(&leaf - layout_.leaves.data()));
    }
    rays_.open[chunk] &= static_cast<std::uint16_t>(~blocked);
    return count;
  }

  // The rays in doubt, one by one, by the triangles that may block them.
  HWY_NOINLINE std::uint32_t resolve(const Leaf& leaf, const LeafPlanes& planes, int chunk, std::uint32_t lanes) const {
    std::uint32_t blocked = 0;
    for (int triangle = 0; triangle < leaf.triangle_count(); ++triangle) {
      const std::uint32_t in_doubt = planes.blocked(triangle, rays_, parts_, chunk).perhaps & lanes & ~blocked;
      if (in_doubt == 0) continue;
      DefinedTriangle defined(layout_, query_, leaf.primitives[triangle]);
      for (std::uint32_t rest = in_doubt; rest != 0; rest &= rest - 1) {
        const int lane = std::countr_zero(rest);
        if (defined.blocks(chunk * kLaneCount + lane)) blocked |= 1u << lane;
      }
    }
    return blocked;
  }

  const Layout& layout_;
  const Query& query_;
  const PatternCones& pattern_cones_;
  const LeafReceiver& receiver_;
  RaySet& rays_;
  const Parts& parts_;
  const ChunkCones* cones_;
};

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
