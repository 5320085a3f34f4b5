// The traversal that the kernels share: once through the hierarchy for all rays of a receiver.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 5.
#pragma once

#include <bit>
#include <span>

#include "bvh/blocker_memory.h"
#include "bvh/box_test.h"
#include "bvh/layout.h"
#include "bvh/ray_parts.h"
#include "bvh/triangle_test.h"
#include "lkao/ambient_occlusion.h"

namespace lkao::bvh {

// What a receiver asks of the hierarchy.
struct Query {
  std::span<const Node> roots;  // where to begin: layout.root(), or entry nodes for the origin of the rays
  const ReceiverRays& rays;
  const OcclusionMask& open;  // rays to decide about: rays.cast or fewer
  float radius = 0;
  Sidedness sidedness = Sidedness::two_sided;
  std::uint32_t excluded_primitive = kNoPrimitive;
  const RayParts* parts = nullptr;  // null: whole rays
  BlockerMemory* memory = nullptr;  // of this layout; null: none

  // Where rays begin and end to count, at the earliest and latest.
  float near() const { return parts != nullptr ? parts->near : 0; }
  float far() const { return parts != nullptr ? parts->far : radius; }
};

// The definition for one triangle as the query's receiver sees it.
inline TriangleTest make_test(const Layout& layout, std::uint32_t primitive, const Query& query) {
  return {layout.corner(primitive, 0),
          layout.corner(primitive, 1),
          layout.corner(primitive, 2),
          query.rays.origin,
          query.radius,
          query.sidedness};
}

// The definition for one ray of the query.
inline bool blocks(const TriangleTest& test, const Query& query, int ray) {
  if (query.parts == nullptr) return test.blocks(query.rays.ray(ray));
  return test.blocks(query.rays.ray(ray), query.parts->begin[ray], query.parts->end[ray]);
}

// Calls `function(ray)` for every ray of the mask.
template <typename Function>
void for_each_ray(const OcclusionMask& mask, int word_count, const Function& function) {
  for (int word = 0; word < word_count; ++word) {
    for (std::uint64_t bits = mask.words[word]; bits != 0; bits &= bits - 1) {
      function(word * 64 + std::countr_zero(bits));
    }
  }
}

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
