// Once through the hierarchy for all rays of a receiver: the traversal of the kernels that have a mask for each node,
// scalar and table. The SIMD kernel has its own.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 5.
#pragma once

#include "bvh/layout.h"
#include "bvh/query.h"
#include "bvh/ray_box.h"

namespace lkao::bvh {

// A kernel says which rays may meet a box and which rays a triangle blocks:
//   OcclusionMask node_mask(const Bounds& box, const OcclusionMask& mask): rays of `mask` that may meet the box.
//   OcclusionMask triangle_mask(std::uint32_t primitive, const OcclusionMask& mask): rays of `mask` it blocks.
template <typename Kernel>
class Traversal {
 public:
  Traversal(const Layout& layout, const Query& query, Kernel& kernel)
      : layout_(layout), query_(query), kernel_(kernel), open_(query.open) {}

  // Rays that are blocked, of those to decide about.
  OcclusionMask run() {
    for (const Node& root : query_.roots) visit(root, open_);
    return query_.open & ~open_;
  }

 private:
  // `mask`: rays that may meet the node.
  void visit(const Node& node, const OcclusionMask& mask) {
    OcclusionMask child_masks[kWidth];
    int order[kWidth];
    const int child_count = order_children(node, mask & open_, child_masks, order);
    for (int i = 0; i < child_count; ++i) {
      const ChildRef child = node.children[order[i]];
      const OcclusionMask still_open = child_masks[order[i]] & open_;
      if (!still_open.any()) continue;  // "processing them would have no effect on the result"
      if (child.is_leaf()) {
        visit(layout_.leaves[child.index()], still_open);
      } else {
        visit(layout_.nodes[child.index()], still_open);
      }
    }
  }

  void visit(const Leaf& leaf, const OcclusionMask& mask) {
    for (int i = 0; i < leaf.triangle_count(); ++i) {
      if (leaf.primitives[i] == query_.excluded_primitive) continue;
      open_ = open_ & ~kernel_.triangle_mask(leaf.primitives[i], mask & open_);
    }
  }

  // Finds the rays of `mask` that may meet each child, and the children that have any, those with most first ("builds
  // up occlusion quickly in the beginning"). The order cannot change the result, only the work.
  int order_children(const Node& node, const OcclusionMask& mask, OcclusionMask (&child_masks)[kWidth],
                     int (&order)[kWidth]) {
    int ray_counts[kWidth];
    int child_count = 0;
    for (int i = 0; i < kWidth && !node.children[i].is_empty(); ++i) {
      const Bounds box = node.child_bounds(i);
      if (is_out_of_reach(box, query_.rays.origin, query_.rays.up, query_.near(), query_.far())) continue;
      child_masks[i] = kernel_.node_mask(box, mask);
      ray_counts[i] = child_masks[i].count();
      if (ray_counts[i] == 0) continue;
      int place = child_count++;
      for (; place > 0 && ray_counts[order[place - 1]] < ray_counts[i]; --place) order[place] = order[place - 1];
      order[place] = i;
    }
    return child_count;
  }

  const Layout& layout_;
  const Query& query_;
  Kernel& kernel_;
  OcclusionMask open_;  // cast and not yet blocked
};

}  // namespace lkao::bvh
