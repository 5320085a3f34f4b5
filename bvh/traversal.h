// Once through the hierarchy for all rays of a receiver: the traversal of the kernels that have a mask for each node,
// scalar and table. The SIMD kernel has its own.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 5.
#pragma once

#include <cstdint>
#include <span>

#include "bvh/layout.h"
#include "bvh/query.h"
#include "bvh/ray_box.h"
#include "bvh/scene_query.h"

namespace lkao::bvh {

// A kernel says which rays may meet a box and which rays a triangle blocks:
//   OcclusionMask node_mask(const Bounds& box, const OcclusionMask& mask): rays of `mask` that may meet the box.
//   OcclusionMask triangle_mask(const Layout& layout, const Query& query, std::uint32_t primitive,
//                               const OcclusionMask& mask): rays of `mask` it blocks.
// Both in the world, where the rays are: the boxes of a mesh that stands somewhere are taken there.
//
// `leaf_mask(leaf, mask)`: rays of `mask` that the leaf of that number blocks.
template <typename Kernel, typename LeafMask>
class Traversal {
 public:
  Traversal(std::span<const Node> nodes, const Query& query, Kernel& kernel, const LeafMask& leaf_mask)
      : nodes_(nodes), query_(query), kernel_(kernel), leaf_mask_(leaf_mask), open_(query.open) {}

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
        open_ = open_ & ~leaf_mask_(child.index(), still_open);
      } else {
        visit(nodes_[child.index()], still_open);
      }
    }
  }

  // Finds the rays of `mask` that may meet each child, and the children that have any, those with most first ("builds
  // up occlusion quickly in the beginning"). The order cannot change the result, only the work.
  int order_children(const Node& node, const OcclusionMask& mask, OcclusionMask (&child_masks)[kWidth],
                     int (&order)[kWidth]) {
    int ray_counts[kWidth];
    int child_count = 0;
    for (int i = 0; i < kWidth && !node.children[i].is_empty(); ++i) {
      const Bounds own = node.child_bounds(i);
      const Bounds box = query_.placement != nullptr ? place(query_.placement->to_world, own) : own;
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

  std::span<const Node> nodes_;
  const Query& query_;
  Kernel& kernel_;
  const LeafMask& leaf_mask_;
  OcclusionMask open_;  // cast and not yet blocked
};

template <typename Kernel>
OcclusionMask trace(const Layout& layout, const Query& query, Kernel& kernel) {
  const auto leaf_mask = [&](std::uint32_t number, const OcclusionMask& mask) {
    const Leaf& leaf = layout.leaves[number];
    OcclusionMask blocked;
    for (int i = 0; i < leaf.triangle_count(); ++i) {
      if (leaf.primitives[i] == query.excluded_primitive) continue;
      blocked = blocked | kernel.triangle_mask(layout, query, leaf.primitives[i], mask & ~blocked);
    }
    return blocked;
  };
  return Traversal(layout.nodes, query, kernel, leaf_mask).run();
}

template <typename Kernel>
OcclusionMask trace(const SceneLayout& scene, const Query& query, Kernel& kernel) {
  const auto leaf_mask = [&](std::uint32_t instance, const OcclusionMask& mask) {
    if (!may_block(scene, query, instance)) return OcclusionMask();
    return trace(scene.mesh_of(scene.placements[instance]), query_of_instance(scene, query, instance, mask), kernel);
  };
  return Traversal(scene.nodes, query, kernel, leaf_mask).run();
}

}  // namespace lkao::bvh
