#include "bvh/entry_nodes.h"

#include "bvh/bounds.h"
#include "bvh/ray_box.h"

namespace lkao::bvh {
namespace {

// The children of the entry nodes, as they are found. `is_missed(box)`: no ray can reach it.
template <class IsMissed>
class Entries {
 public:
  Entries(std::span<const Node> nodes, const IsMissed& is_missed, int most)
      : nodes_(nodes), is_missed_(is_missed), most_(most) {
    add_children_of(root_of(nodes_));
    while (open_one()) {
    }
  }

  int count() const { return count_; }
  const Bounds& box(int i) const { return boxes_[i]; }
  ChildRef child(int i) const { return children_[i]; }

 private:
  int reached_count(const Node& node) const {
    int count = 0;
    for (int i = 0; i < kWidth && !node.children[i].is_empty(); ++i) {
      count += !is_missed_(node.child_bounds(i));
    }
    return count;
  }

  void add_children_of(const Node& node) {
    for (int i = 0; i < kWidth && !node.children[i].is_empty(); ++i) {
      const Bounds box = node.child_bounds(i);
      if (is_missed_(box)) continue;
      const ChildRef child = node.children[i];
      reached_counts_[count_] = child.is_leaf() ? most_ + 1 : reached_count(nodes_[child.index()]);
      boxes_[count_] = box;
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
    --count_;
    boxes_[largest] = boxes_[count_];
    children_[largest] = children_[count_];
    reached_counts_[largest] = reached_counts_[count_];
    add_children_of(opened);
    return true;
  }

  std::span<const Node> nodes_;
  const IsMissed& is_missed_;
  int most_;
  int count_ = 0;
  Bounds boxes_[EntryNodes::kMostChildren];
  ChildRef children_[EntryNodes::kMostChildren];
  // Children of each child within reach; more than there is room for where it is a leaf.
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
  const auto is_missed = [&](const Bounds& box) { return is_farther_than(radius, box, origins); };
  set(Entries(nodes, is_missed, most_children));
}

EntryNodes::EntryNodes(std::span<const Node> nodes, const Shaft& shaft, int most_children) {
  const auto is_missed = [&](const Bounds& box) { return shaft.misses(box); };
  set(Entries(nodes, is_missed, most_children));
}

}  // namespace lkao::bvh
