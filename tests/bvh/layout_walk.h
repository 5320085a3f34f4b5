// A walk over a finished hierarchy, depth first, that checks what must hold of any.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <glm/vector_relational.hpp>

#include "bvh/layout.h"

namespace lkao::tests {

inline bool is_within(const Bounds& inner, const Bounds& outer) {
  return glm::all(glm::greaterThanEqual(inner.lower, outer.lower)) &&
         glm::all(glm::lessThanEqual(inner.upper, outer.upper));
}

// Boxes nest; nodes and leaves are numbered in the order of the walk, so none is shared and subtrees lie together;
// leaves repeat their first triangle in the places that are left.
class LayoutWalk {
 public:
  explicit LayoutWalk(const bvh::Layout& layout) : layout_(layout) {
    if (!layout.nodes.empty()) visit(0, {-kInfinity, kInfinity}, 1);
  }

  struct Reference {
    std::uint32_t primitive;
    Bounds box;  // of its leaf
  };
  std::vector<Reference> references;
  std::uint32_t node_count = 0, leaf_count = 0;
  int depth = 0;

  // Sorted, each once.
  std::vector<std::uint32_t> primitives() const {
    std::vector<std::uint32_t> numbers;
    for (const Reference& reference : references) numbers.push_back(reference.primitive);
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    return numbers;
  }

 private:
  static constexpr glm::vec3 kInfinity{std::numeric_limits<float>::infinity()};

  void visit(std::uint32_t index, const Bounds& box, int level) {
    EXPECT_EQ(index, node_count);
    ++node_count;
    depth = std::max(depth, level);
    const bvh::Node& node = layout_.nodes[index];
    EXPECT_FALSE(node.children[0].is_empty());
    for (int i = 0; i < bvh::kWidth; ++i) visit_child(node, i, box, level);
  }

  void visit_child(const bvh::Node& node, int i, const Bounds& parent_box, int level) {
    const bvh::ChildRef child = node.children[i];
    const Bounds box = node.child_bounds(i);
    if (child.is_empty()) {
      EXPECT_TRUE(box.lower == kInfinity && box.upper == kInfinity);
      return;
    }
    EXPECT_FALSE(i > 0 && node.children[i - 1].is_empty()) << "a child behind an empty one";
    EXPECT_TRUE(is_within(box, parent_box) || node.is_unreachable(i)) << "child " << i;
    if (child.is_leaf()) {
      visit_leaf(child.index(), box);
    } else {
      visit(child.index(), box, level + 1);
    }
  }

  void visit_leaf(std::uint32_t index, const Bounds& box) {
    EXPECT_EQ(index, leaf_count);
    ++leaf_count;
    if (box.lower == kInfinity) return;  // all that it holds rests
    const bvh::Leaf& leaf = layout_.leaves[index];
    for (int i = 0; i < bvh::kLeafWidth; ++i) {
      if (i < leaf.triangle_count()) {
        EXPECT_EQ(std::count(leaf.primitives, leaf.primitives + i, leaf.primitives[i]), 0);
        references.push_back({leaf.primitives[i], box});
      } else {
        EXPECT_EQ(leaf.primitives[i], leaf.primitives[0]);
      }
    }
  }

  const bvh::Layout& layout_;
};

}  // namespace lkao::tests
