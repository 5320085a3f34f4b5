#include "bvh/scene_layout.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include "bvh/bounds.h"
#include "bvh/build_tree.h"
#include "bvh/split_builder.h"

namespace lkao::bvh {
namespace {

Bounds bounds_of(const Node& node) {
  Bounds bounds = kNowhere;
  for (int i = 0; i < kWidth && !node.children[i].is_empty(); ++i) bounds = merge(bounds, node.child_bounds(i));
  return bounds;
}

// From the builder's tree, whose leaves hold up to four instances, to nodes whose leaves are one each.
class SceneFlattener {
 public:
  explicit SceneFlattener(SceneLayout& scene) : scene_(scene) {}

  void fill(const BuildTree& tree) {
    const std::size_t place = scene_.nodes.size();
    scene_.nodes.push_back(Node::empty());
    if (tree.is_leaf()) {
      const auto& leaf = static_cast<const BuildLeaf&>(tree);
      for (std::size_t i = 0; i < leaf.size.reference_count; ++i) set_instance(place, static_cast<int>(i), leaf, i);
      return;
    }
    const auto& node = static_cast<const BuildNode&>(tree);
    for (std::uint32_t i = 0; i < node.child_count; ++i) {
      const BuildTree& child = *node.children[i];
      const int number = static_cast<int>(i);
      if (child.is_leaf() && child.size.reference_count == 1) {
        set_instance(place, number, static_cast<const BuildLeaf&>(child), 0);
        continue;
      }
      const auto child_place = static_cast<std::uint32_t>(scene_.nodes.size());
      scene_.nodes[place].set_child(number, node.bounds[i], ChildRef::node(child_place));
      fill(child);
    }
  }

 private:
  void set_instance(std::size_t place, int child, const BuildLeaf& leaf, std::size_t i) {
    const std::uint32_t instance = leaf.primitives[i];
    scene_.nodes[place].set_child(child, scene_.placements[instance].box, ChildRef::leaf(instance));
  }

  SceneLayout& scene_;
};

void set_bounds(SceneLayout& scene) {
  scene.bounds = kNowhere;
  for (const Placement& placement : scene.placements) scene.bounds = merge(scene.bounds, placement.box);
}

// Children come behind their parents.
void refit(SceneLayout& scene) {
  for (std::size_t k = scene.nodes.size(); k-- > 0;) {
    Node& node = scene.nodes[k];
    for (int i = 0; i < kWidth && !node.children[i].is_empty(); ++i) {
      const ChildRef child = node.children[i];
      const Bounds box = child.is_leaf() ? scene.placements[child.index()].box : bounds_of(scene.nodes[child.index()]);
      node.set_child(i, box, child);
    }
  }
}

}  // namespace

double cost_of(const SceneLayout& scene) {
  double sum = 0;
  for (const Node& node : scene.nodes) {
    for (int i = 0; i < kWidth && !node.children[i].is_empty(); ++i) sum += half_area(node.child_bounds(i));
  }
  const double whole = half_area(scene.bounds);
  return whole > 0 ? sum / whole : 0;
}

void build_nodes(SceneLayout& scene) {
  scene.nodes.clear();
  set_bounds(scene);
  if (scene.plain() != nullptr) {
    scene.bounds = scene.plain()->bounds;
    return;
  }
  const PackedMesh no_mesh;
  SplitBuilder builder(no_mesh, false);
  Pieces pieces;
  pieces.reserve(builder.capacity_for(scene.placements.size()));
  for (std::uint32_t i = 0; i < scene.placements.size(); ++i) {
    const Bounds& box = scene.placements[i].box;
    if (is_nowhere(box)) continue;
    pieces.emplace_back(Box{{box.lower.x, box.lower.y, box.lower.z, 0}, {box.upper.x, box.upper.y, box.upper.z, 0}}, i);
  }
  if (pieces.empty()) return;
  const BuildTree& tree = builder.build(std::move(pieces));
  scene.nodes.reserve(tree.size.node_count + tree.size.leaf_count);
  SceneFlattener(scene).fill(tree);
  scene.built_cost = cost_of(scene);
}

void update_nodes(SceneLayout& scene) {
  // Tried on moving crowds (bench/results/instances.csv): below this, building costs more than it spares.
  constexpr double kMostGrowth = 1.5;
  if (scene.nodes.empty() || scene.plain() != nullptr) {
    build_nodes(scene);
    return;
  }
  set_bounds(scene);
  refit(scene);
  if (cost_of(scene) > kMostGrowth * scene.built_cost) build_nodes(scene);
}

}  // namespace lkao::bvh
