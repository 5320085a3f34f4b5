// Embree's builder: the tree it makes, in memory of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <embree3/rtcore.h>

#include "bvh/huge_pages.h"
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

// Not touched before the builder does, where memory is only reserved.
using BuildPrimitives = std::vector<RTCBuildPrimitive, HugePageAllocator<RTCBuildPrimitive>>;

// Owns Embree's device and builder; the tree lives as long as this.
class EmbreeBuilder {
 public:
  EmbreeBuilder();
  ~EmbreeBuilder();
  EmbreeBuilder(const EmbreeBuilder&) = delete;
  EmbreeBuilder& operator=(const EmbreeBuilder&) = delete;

  // The tree over the boxes of some triangles of `mesh`, at least one, whose numbers are the primID of the boxes. The
  // tree is the same on any number of threads.
  const BuildTree& build(const TriangleMesh& mesh, BuildPrimitives primitives, bool spatial_splits);

 private:
  RTCDevice device_;
  RTCBVH bvh_;
};

}  // namespace lkao::bvh
