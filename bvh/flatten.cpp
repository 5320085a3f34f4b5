#include "bvh/flatten.h"

#include <cstdint>

#include <tbb/parallel_for.h>

#include "bvh/box_margin.h"
#include "bvh/leaf.h"

namespace lkao::bvh {
namespace {

class Flattener {
 public:
  explicit Flattener(Layout& layout) : layout_(layout) {}

  // Where a subtree begins: its first node and its first leaf.
  struct Place {
    std::uint32_t node = 0;
    std::uint32_t leaf = 0;
  };

  void fill(const BuildTree& tree, Place place) {
    if (tree.is_leaf()) {
      fill_leaf(static_cast<const BuildLeaf&>(tree), place);
    } else {
      fill_node(static_cast<const BuildNode&>(tree), place);
    }
  }

 private:
  void fill_leaf(const BuildLeaf& source, Place place) {
    layout_.leaves[place.leaf] = make_leaf(layout_.mesh, {source.primitives, source.size.reference_count},
                                           layout_.options.cut_outs, layout_.grids.get());
  }

  // The sizes of the children say where each begins, so that all of them can be filled at once.
  void fill_node(const BuildNode& source, Place place) {
    Node& node = layout_.nodes[place.node];
    node = Node::empty();
    Place places[kWidth];
    Place next{place.node + 1, place.leaf};
    for (std::uint32_t i = 0; i < source.child_count; ++i) {
      const BuildTree& child = *source.children[i];
      places[i] = next;
      next = {next.node + child.size.node_count, next.leaf + child.size.leaf_count};
      node.set_child(static_cast<int>(i), with_margin(source.bounds[i]),
                     child.is_leaf() ? ChildRef::leaf(places[i].leaf) : ChildRef::node(places[i].node));
    }
    const auto fill_child = [&](std::uint32_t i) { fill(*source.children[i], places[i]); };
    constexpr std::uint32_t kLeavesWorthATask = 256;
    if (source.size.leaf_count >= kLeavesWorthATask) {
      tbb::parallel_for(0u, source.child_count, fill_child);
    } else {
      for (std::uint32_t i = 0; i < source.child_count; ++i) fill_child(i);
    }
  }

  Layout& layout_;
};

}  // namespace

void flatten(const BuildTree& root, Layout& layout) {
  layout.leaves.resize(root.size.leaf_count);
  if (!root.is_leaf()) {
    layout.nodes.resize(root.size.node_count);
    Flattener(layout).fill(root, {});
    return;
  }
  // The root is a node even over a single leaf.
  layout.nodes.push_back(Node::empty());
  layout.nodes[0].set_child(0, with_margin(layout.bounds), ChildRef::leaf(0));
  Flattener(layout).fill(root, {});
}

}  // namespace lkao::bvh
