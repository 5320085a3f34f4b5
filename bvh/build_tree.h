// The tree that a builder makes, before it is laid out for queries.
#pragma once

#include <cstddef>
#include <cstdint>

#include "bvh/layout.h"

namespace lkao::bvh {

struct TreeSize {
  std::uint32_t node_count = 0;
  std::uint32_t leaf_count = 0;
  std::size_t reference_count = 0;  // entries of all leaves

  TreeSize& operator+=(const TreeSize& other) {
    node_count += other.node_count;
    leaf_count += other.leaf_count;
    reference_count += other.reference_count;
    return *this;
  }
};

// A BuildNode or, where there is none in its subtree, a BuildLeaf.
struct BuildTree {
  TreeSize size;  // of the subtree, with its root

  bool is_leaf() const { return size.node_count == 0; }
};

struct BuildNode : BuildTree {
  std::uint32_t child_count;
  const BuildTree* children[kWidth];
  Bounds bounds[kWidth];  // of the children
};

struct BuildLeaf : BuildTree {
  std::uint32_t primitives[kLeafWidth];  // as many as size.reference_count, all different
};

}  // namespace lkao::bvh
