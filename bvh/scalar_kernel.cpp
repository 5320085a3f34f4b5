// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 5: the hierarchy is
// traversed once for all rays, with a mask of the rays that may still meet a node; children with more of them first.
//
// Differs from the paper: node masks come from slab tests of single rays and triangle masks from TriangleTest, not from
// a table, so the result is exact.
#include "bvh/scalar_kernel.h"

#include <bit>

#include "bvh/box_test.h"
#include "bvh/triangle_test.h"

namespace lkao::bvh {
namespace {

class Traversal {
 public:
  Traversal(const Layout& layout, const Query& query)
      : layout_(layout), query_(query), word_count_(query.rays.ray_count / 64), open_(query.rays.cast) {
    for (int i = 0; i < query.rays.ray_count; ++i) box_rays_[i] = BoxRay(query.rays.rays[i]);
  }

  OcclusionMask run() {
    if (!layout_.nodes.empty() && open_.any()) visit(layout_.nodes[0], open_);
    return query_.rays.cast & ~open_;
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
      if (!still_open.any()) continue;
      if (child.is_leaf()) {
        visit(layout_.leaves[child.index()], still_open);
      } else {
        visit(layout_.nodes[child.index()], still_open);
      }
    }
  }

  // Finds the rays of `mask` that may meet each child, and the children that have any, those with most first (Sec. 5:
  // the child that may block most). The order cannot change the result, only the work.
  int order_children(const Node& node, const OcclusionMask& mask, OcclusionMask (&child_masks)[kWidth],
                     int (&order)[kWidth]) const {
    int ray_counts[kWidth];
    int child_count = 0;
    for (int i = 0; i < kWidth && !node.children[i].is_empty(); ++i) {
      child_masks[i] = node_mask(node.child_bounds(i), mask);
      ray_counts[i] = child_masks[i].count();
      if (ray_counts[i] == 0) continue;
      int place = child_count++;
      for (; place > 0 && ray_counts[order[place - 1]] < ray_counts[i]; --place) order[place] = order[place - 1];
      order[place] = i;
    }
    return child_count;
  }

  void visit(const Leaf& leaf, const OcclusionMask& mask) {
    for (int i = 0; i < kWidth && leaf.primitives[i] != kNoPrimitive; ++i) {
      if (leaf.primitives[i] == query_.excluded_primitive) continue;
      const TriangleTest test(leaf.corner(i, 0), leaf.corner(i, 1), leaf.corner(i, 2), query_.rays.origin,
                              query_.radius, query_.sidedness);
      if (!test.can_block()) continue;
      for_each_ray(mask & open_, [&](int ray) {
        if (test.blocks(query_.rays.rays[ray])) open_.reset(ray);
      });
    }
  }

  // Rays of `mask` that may meet the box.
  OcclusionMask node_mask(const Bounds& box, const OcclusionMask& mask) const {
    OcclusionMask met;
    if (is_out_of_reach(box, query_.rays.origin, query_.up, query_.radius)) return met;
    for_each_ray(mask, [&](int ray) {
      if (may_meet(box_rays_[ray], query_.rays.origin, box)) met.set(ray);
    });
    return met;
  }

  template <typename Function>
  void for_each_ray(const OcclusionMask& mask, const Function& function) const {
    for (int word = 0; word < word_count_; ++word) {
      for (std::uint64_t bits = mask.words[word]; bits != 0; bits &= bits - 1) {
        function(word * 64 + std::countr_zero(bits));
      }
    }
  }

  const Layout& layout_;
  const Query& query_;
  int word_count_;
  BoxRay box_rays_[kMaxRayCount];
  OcclusionMask open_;  // cast and not yet blocked
};

}  // namespace

OcclusionMask trace_scalar(const Layout& layout, const Query& query) { return Traversal(layout, query).run(); }

}  // namespace lkao::bvh
