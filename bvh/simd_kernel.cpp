// Compiled once for every SIMD target (Highway); the fastest that the processor has is chosen at run time.
//
// Wide phase: nodes are visited with a mask of all rays, tested 16 at a time (a chunk: neighbours in the pattern).
// Narrow phase: once at most 16 rays may meet a child they are packed into one packet, which finishes that subtree.
//
// Differs from the paper (see traversal.h): masks come from box and plane tests of the rays in single precision. They
// are conservative; a ray within their rounding of a triangle's planes is decided by TriangleTest. So every target
// gives the bits of the scalar kernel, whether it fuses multiply-adds or not.
#include "bvh/simd_kernel.h"

#include "bvh/triangle_test.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bvh/simd_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "bvh/simd/box_masks-inl.h"
#include "bvh/simd/leaf_planes-inl.h"
#include "bvh/simd/ray_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {
namespace {

// Embree's builder is told not to go deeper.
constexpr int kMaxDepth = 64;
// Up to so many rays, a vector of boxes for each ray beats a vector of rays for each box.
constexpr int kFewRays = 6;

class SimdTraversal {
 public:
  SimdTraversal(const Layout& layout, const Query& query)
      : layout_(layout), query_(query), chunk_count_(query.rays.ray_count / kLaneCount), open_(query.rays.cast) {
    load_rays(query.rays, rays_);
  }

  OcclusionMask run() {
    if (!layout_.nodes.empty() && query_.rays.cast.any()) visit(layout_.nodes[0], ActiveChunks(open_, chunk_count_));
    return query_.rays.cast & ~open_.mask();
  }

 private:
  // --- Wide phase ---

  // `active`: the open rays that may meet the node.
  void visit(const Node& node, const ActiveChunks& active) {
    const RelativeBoxes boxes(node, query_.rays.origin);
    ActiveChunks child_rays[kWidth];
    int order[kWidth], child_count = 0;
    for (std::uint32_t children = boxes.within_reach(query_.up, query_.radius); children != 0;
         children &= children - 1) {
      const int child = std::countr_zero(children);
      ActiveChunks& met = child_rays[child];
      for (int i = 0; i < active.count; ++i) {
        const int chunk = active.chunks[i];
        met.add(chunk, active.masks[i] & boxes.rays_meeting(child, rays_.at(chunk * kLaneCount)));
      }
      if (met.count == 0) continue;
      int place = child_count++;
      for (; place > 0 && child_rays[order[place - 1]].ray_count < met.ray_count; --place)
        order[place] = order[place - 1];
      order[place] = child;
    }
    for (int i = 0; i < child_count; ++i) visit(node.children[order[i]], child_rays[order[i]].open_ones(open_));
  }

  void visit(ChildRef child, const ActiveChunks& active) {
    if (active.ray_count == 0) return;
    if (active.ray_count <= kLaneCount) {
      trace_packet(child, active);
    } else if (child.is_leaf()) {
      visit(layout_.leaves[child.index()], active);
    } else {
      visit(layout_.nodes[child.index()], active);
    }
  }

  void visit(const Leaf& leaf, const ActiveChunks& active) {
    const LeafPlanes planes(leaf, query_);
    for (std::uint32_t triangles = planes.survivors(); triangles != 0; triangles &= triangles - 1) {
      const int triangle = std::countr_zero(triangles);
      for (int i = 0; i < active.count; ++i) {
        const int chunk = active.chunks[i];
        const std::uint32_t mask = active.masks[i] & open_.chunks[chunk];
        if (mask == 0) continue;
        const std::uint32_t blocked = blocked_lanes(leaf, planes, triangle, rays_.at(chunk * kLaneCount), mask);
        open_.chunks[chunk] &= static_cast<std::uint16_t>(~blocked);
      }
    }
  }

  // --- Narrow phase ---

  // Finishes the subtree for at most 16 rays.
  void trace_packet(ChildRef root, const ActiveChunks& active) {
    Packet packet;
    packet.gather(rays_, active);
    std::uint32_t open = (1u << packet.count) - 1;
    struct Entry {
      ChildRef child;
      std::uint32_t lanes;
    };
    Entry stack[kWidth * kMaxDepth];
    int size = 0;
    stack[size++] = {root, open};
    while (size > 0 && open != 0) {
      const Entry entry = stack[--size];
      const std::uint32_t lanes = entry.lanes & open;
      if (lanes == 0) continue;
      if (entry.child.is_leaf()) {
        open &= ~blocked_in_leaf(layout_.leaves[entry.child.index()], packet, lanes);
        continue;
      }
      std::uint32_t child_lanes[kWidth];
      const Node& node = layout_.nodes[entry.child.index()];
      for (std::uint32_t met = meet_children(node, packet, lanes, child_lanes); met != 0; met &= met - 1) {
        const int child = std::countr_zero(met);
        prefetch(node.children[child]);
        stack[size++] = {node.children[child], child_lanes[child]};
      }
    }
    packet.close_blocked(open, open_);
  }

  // Children that some lane may meet, and the lanes for each of them. Few rays are tested one by one against all boxes,
  // many against one box at a time.
  HWY_INLINE std::uint32_t meet_children(const Node& node, const Packet& packet, std::uint32_t lanes,
                                         std::uint32_t (&child_lanes)[kWidth]) const {
    const RelativeBoxes boxes(node, query_.rays.origin);
    std::uint32_t met = 0;
    if (std::popcount(lanes) <= kFewRays) {
      for (std::uint32_t& child : child_lanes) child = 0;
      for (; lanes != 0; lanes &= lanes - 1) {
        const int lane = std::countr_zero(lanes);
        const std::uint32_t children =
            boxes.children_met(packet.inverse_x[lane], packet.inverse_y[lane], packet.inverse_z[lane]);
        met |= children;
        for (std::uint32_t rest = children; rest != 0; rest &= rest - 1) {
          child_lanes[std::countr_zero(rest)] |= 1u << lane;
        }
      }
      return met;
    }
    for (int i = 0; i < kWidth && !node.children[i].is_empty(); ++i) {
      child_lanes[i] = lanes & boxes.rays_meeting(i, packet.lanes());
      met |= static_cast<std::uint32_t>(child_lanes[i] != 0) << i;
    }
    return met;
  }

  // Asks for the child's memory early: large scenes do not fit the caches.
  HWY_INLINE void prefetch(ChildRef child) const {
    const bool is_leaf = child.is_leaf();
    const void* start =
        is_leaf ? static_cast<const void*>(&layout_.leaves[child.index()]) : &layout_.nodes[child.index()];
    const std::size_t size = is_leaf ? sizeof(Leaf) : sizeof(Node);
    for (std::size_t offset = 0; offset < size; offset += 64) {
      hwy::Prefetch(static_cast<const std::uint8_t*>(start) + offset);
    }
  }

  std::uint32_t blocked_in_leaf(const Leaf& leaf, const Packet& packet, std::uint32_t lanes) {
    const LeafPlanes planes(leaf, query_);
    std::uint32_t blocked = 0;
    for (std::uint32_t triangles = planes.survivors(); triangles != 0; triangles &= triangles - 1) {
      const int triangle = std::countr_zero(triangles);
      blocked |= blocked_lanes(leaf, planes, triangle, packet.lanes(), lanes & ~blocked);
      if (blocked == lanes) break;
    }
    return blocked;
  }

  // --- Both ---

  std::uint32_t blocked_lanes(const Leaf& leaf, const LeafPlanes& planes, int triangle, const RayLanes& rays,
                              std::uint32_t mask) const {
    const LaneBounds bounds = planes.blocked(triangle, rays, mask);
    if (bounds.in_doubt == 0) return bounds.sure;
    return bounds.sure | resolve(leaf, triangle, rays, bounds.in_doubt);
  }

  // The rays in doubt, one by one.
  HWY_NOINLINE std::uint32_t resolve(const Leaf& leaf, int triangle, const RayLanes& rays, std::uint32_t lanes) const {
    const TriangleTest test(leaf.corner(triangle, 0), leaf.corner(triangle, 1), leaf.corner(triangle, 2),
                            query_.rays.origin, query_.radius, query_.sidedness);
    std::uint32_t blocked = 0;
    for (; test.can_block() && lanes != 0; lanes &= lanes - 1) {
      const int lane = std::countr_zero(lanes);
      if (test.blocks({rays.x[lane], rays.y[lane], rays.z[lane]})) blocked |= 1u << lane;
    }
    return blocked;
  }

  const Layout& layout_;
  const Query& query_;
  int chunk_count_;
  RayArrays rays_;
  ChunkMask open_;  // cast and not yet blocked
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
