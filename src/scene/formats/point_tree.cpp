#include "scene/formats/point_tree.h"

#include <numeric>

#include <glm/common.hpp>

namespace lkao::scene {

void PointTree::build(std::span<const glm::dvec2> points) {
  constexpr std::size_t kLeafSize = 8;
  points_ = points;
  work_ = 0;
  is_marked_.assign(points.size(), false);
  leaf_of_.resize(points.size());
  order_.resize(points.size());
  std::iota(order_.begin(), order_.end(), 0u);
  std::uint32_t leaf_count = 1;
  while (leaf_count * kLeafSize < points.size()) leaf_count *= 2;
  first_leaf_ = leaf_count - 1;
  nodes_.assign(2 * leaf_count - 1, {});
  build_node(0, 0, static_cast<std::uint32_t>(points.size()));
  // Parents stand in front of their children.
  for (std::uint32_t i = 0; i < first_leaf_; ++i) {
    const std::uint32_t begin = nodes_[i].begin, end = nodes_[i].end, middle = begin + (end - begin) / 2;
    const glm::dvec2 size = nodes_[i].upper - nodes_[i].lower;
    const glm::dvec2::length_type axis = size.x >= size.y ? 0 : 1;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) { return points[a][axis] < points[b][axis]; });
    build_node(2 * i + 1, begin, middle);
    build_node(2 * i + 2, middle, end);
  }
  for (std::uint32_t i = first_leaf_; i < nodes_.size(); ++i) {
    for (std::uint32_t k = nodes_[i].begin; k < nodes_[i].end; ++k) leaf_of_[order_[k]] = i;
  }
}

void PointTree::build_node(std::uint32_t index, std::uint32_t begin, std::uint32_t end) {
  Node& node = nodes_[index];
  node.begin = begin;
  node.end = end;
  node.lower = node.upper = points_[order_[begin]];
  for (std::uint32_t i = begin + 1; i < end; ++i) {
    node.lower = glm::min(node.lower, points_[order_[i]]);
    node.upper = glm::max(node.upper, points_[order_[i]]);
  }
}

void PointTree::mark(std::uint32_t point, bool is_marked) {
  if (is_marked_[point] == is_marked) return;
  is_marked_[point] = is_marked;
  for (std::uint32_t node = leaf_of_[point];; node = (node - 1) / 2) {
    nodes_[node].marked_count += is_marked ? 1 : -1u;
    if (node == 0) return;
  }
}

}  // namespace lkao::scene
