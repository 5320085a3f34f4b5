#include "bvh/entry_nodes.h"

#include <bit>
#include <cstdint>

#include "bvh/bounds.h"
#include "bvh/ray_box.h"

namespace lkao::bvh {
namespace {

// The children of the entry nodes, as they are found. `reached_children(node)`: those that a ray may reach, as bits.
template <class ReachedChildren>
class Entries {
 public:
  Entries(std::span<const Node> nodes, const ReachedChildren& reached_children, int most)
      : nodes_(nodes), reached_children_(reached_children), most_(most) {
    const Node& root = root_of(nodes_);
    add_children(root, reached_children_(root));
    while (open_one()) {
    }
  }

  int count() const { return count_; }
  const Bounds& box(int i) const { return boxes_[i]; }
  ChildRef child(int i) const { return children_[i]; }

 private:
  void add_children(const Node& node, std::uint32_t children) {
    for (; children != 0; children &= children - 1) {
      const int i = std::countr_zero(children);
      const ChildRef child = node.children[i];
      reached_[count_] = child.is_leaf() ? 0 : reached_children_(nodes_[child.index()]);
      reached_counts_[count_] = child.is_leaf() ? most_ + 1 : std::popcount(reached_[count_]);
      boxes_[count_] = node.child_bounds(i);
      children_[count_++] = child;
    }
  }

  // Replaces the largest child that leaves room for its children by them. False where there is none.
  bool open_one() {
    int largest = -1;
    double largest_area = -1;
    for (int i = 0; i < count_; ++i) {
      if (count_ - 1 + reached_counts_[i] > most_) continue;
      const double area = half_area(boxes_[i]);
      if (area > largest_area) {
        largest = i;
        largest_area = area;
      }
    }
    if (largest < 0) return false;
    const Node& opened = nodes_[children_[largest].index()];
    const std::uint32_t reached = reached_[largest];
    --count_;
    boxes_[largest] = boxes_[count_];
    children_[largest] = children_[count_];
    reached_[largest] = reached_[count_];
    reached_counts_[largest] = reached_counts_[count_];
    add_children(opened, reached);
    return true;
  }

  std::span<const Node> nodes_;
  const ReachedChildren& reached_children_;
  int most_;
  int count_ = 0;
  Bounds boxes_[EntryNodes::kMostChildren];
  ChildRef children_[EntryNodes::kMostChildren];
  // Children of each child within reach, as bits, and their number; more than there is room for where it is a leaf.
  std::uint32_t reached_[EntryNodes::kMostChildren];
  int reached_counts_[EntryNodes::kMostChildren];
};

}  // namespace

template <class Entries>
void EntryNodes::set(const Entries& entries) {
  for (int i = 0; i < entries.count(); ++i) {
    if (i % kWidth == 0) nodes_[count_++] = Node::empty();
    nodes_[count_ - 1].set_child(i % kWidth, entries.box(i), entries.child(i));
  }
}

EntryNodes::EntryNodes(std::span<const Node> nodes, const Bounds& origins, float radius, int most_children) {
  const auto reached = [&](const Node& node) {
    std::uint32_t children = 0;
    for (int i = 0; i < kWidth && !node.children[i].is_empty(); ++i) {
      children |= static_cast<std::uint32_t>(!is_farther_than(radius, node.child_bounds(i), origins)) << i;
    }
    return children;
  };
  set(Entries(nodes, reached, most_children));
}

EntryNodes::EntryNodes(std::span<const Node> nodes, const Shaft& shaft, int most_children) {
  const auto reached = [&](const Node& node) { return shaft.met_children(node); };
  set(Entries(nodes, reached, most_children));
}

}  // namespace lkao::bvh
