// Where neighbouring receivers enter the hierarchy.
#pragma once

#include <span>

#include "bvh/layout.h"
#include "bvh/shaft.h"

namespace lkao::bvh {

// Nodes that stand above all that rays of the length `radius` can meet from origins within `origins`: their children
// are up to `most_children` nodes and leaves, from as deep in the hierarchy as that allows. So neighbouring receivers
// skip what lies above; where they are far apart, or the radius is large, that is little.
class EntryNodes {
 public:
  static constexpr int kMostChildren = 32;

  // `nodes`: of a layout, the root first. `most_children`: from kWidth to kMostChildren.
  EntryNodes(std::span<const Node> nodes, const Bounds& origins, float radius, int most_children = kWidth);

  // The same for rays that lie within a shaft.
  EntryNodes(std::span<const Node> nodes, const Shaft& shaft, int most_children = kWidth);

  std::span<const Node> nodes() const { return {nodes_, static_cast<std::size_t>(count_)}; }

 private:
  template <class Entries>
  void set(const Entries& entries);

  Node nodes_[kMostChildren / kWidth];
  int count_ = 0;
};

}  // namespace lkao::bvh
