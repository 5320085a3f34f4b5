#include "bvh/entry_node.h"

#include "bvh/box_test.h"

namespace lkao::bvh {
namespace {

float half_area(const Bounds& box) {
  const glm::vec3 size = box.upper - box.lower;
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

class EntryNode {
 public:
  EntryNode(const Layout& layout, const Bounds& origins, float radius)
      : layout_(layout), origins_(origins), radius_(radius), node_(Node::empty()) {}

  Node make() {
    add_children_of(layout_.root());
    while (open_one()) {
    }
    return node_;
  }

 private:
  int reached_count(const Node& node) const {
    int count = 0;
    for (int i = 0; i < kWidth && !node.children[i].is_empty(); ++i) {
      count += !is_farther_than(radius_, node.child_bounds(i), origins_);
    }
    return count;
  }

  void add_children_of(const Node& node) {
    for (int i = 0; i < kWidth && !node.children[i].is_empty(); ++i) {
      const Bounds box = node.child_bounds(i);
      if (is_farther_than(radius_, box, origins_)) continue;
      const ChildRef child = node.children[i];
      reached_counts_[count_] = child.is_leaf() ? kWidth + 1 : reached_count(layout_.nodes[child.index()]);
      node_.set_child(count_++, box, child);
    }
  }

  // Replaces the largest child that leaves room for its children by them. False where there is none.
  bool open_one() {
    int largest = -1;
    float largest_area = -1;
    for (int i = 0; i < count_; ++i) {
      if (count_ - 1 + reached_counts_[i] > kWidth) continue;
      const float area = half_area(node_.child_bounds(i));
      if (area > largest_area) {
        largest = i;
        largest_area = area;
      }
    }
    if (largest < 0) return false;
    const Node& opened = layout_.nodes[node_.children[largest].index()];
    --count_;
    node_.set_child(largest, node_.child_bounds(count_), node_.children[count_]);
    reached_counts_[largest] = reached_counts_[count_];
    node_.clear_child(count_);
    add_children_of(opened);
    return true;
  }

  const Layout& layout_;
  const Bounds& origins_;
  float radius_;
  Node node_;
  int count_ = 0;
  int reached_counts_[kWidth];  // children of each child within reach; more than there is room for where it is a leaf
};

}  // namespace

Node make_entry_node(const Layout& layout, const Bounds& origins, float radius) {
  return EntryNode(layout, origins, radius).make();
}

}  // namespace lkao::bvh
