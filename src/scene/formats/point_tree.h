// Points in the plane, some of them marked: which marked ones lie in a triangle?
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace lkao::scene {

// Twice the area of the triangle, positive where it is counterclockwise.
inline double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// A balanced k-d tree that looks at some sqrt(n) nodes for a triangle, however the points lie.
class PointTree {
 public:
  using Triangle = std::array<glm::dvec2, 3>;  // counterclockwise

  // Marks none. The points must outlive the tree.
  void build(std::span<const glm::dvec2> points);
  void mark(std::uint32_t point, bool is_marked);

  // Whether some marked point in the closed triangle fulfils the predicate.
  template <typename Predicate>
  bool any_in(const Triangle& triangle, const Predicate& predicate) {
    std::array<std::uint32_t, 64> stack;
    std::size_t stack_size = 0;
    stack[stack_size++] = 0;
    while (stack_size > 0) {
      const std::uint32_t index = stack[--stack_size];
      const Node& node = nodes_[index];
      ++work_;
      if (node.marked_count == 0 || is_apart(node, triangle)) continue;
      if (index < first_leaf_) {
        stack[stack_size++] = 2 * index + 1;
        stack[stack_size++] = 2 * index + 2;
      } else if (any_in_leaf(node, triangle, predicate)) {
        return true;
      }
    }
    return false;
  }

  // Nodes and points looked at since build().
  std::size_t work() const { return work_; }

 private:
  // The children of node i are 2 i + 1 and 2 i + 2.
  struct Node {
    glm::dvec2 lower, upper;
    std::uint32_t begin = 0, end = 0;  // in order_
    std::uint32_t marked_count = 0;
  };

  static bool is_apart(const Node& node, const Triangle& triangle) {
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec2 &p = triangle[i], &q = triangle[(i + 1) % 3];
      // The corner of the box that lies farthest to the left of the edge.
      const glm::dvec2 corner(q.y > p.y ? node.lower.x : node.upper.x, q.x > p.x ? node.upper.y : node.lower.y);
      if (turn(p, q, corner) < 0) return true;
    }
    const auto [left, right] = std::minmax({triangle[0].x, triangle[1].x, triangle[2].x});
    const auto [bottom, top] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
    return node.upper.x < left || node.lower.x > right || node.upper.y < bottom || node.lower.y > top;
  }

  template <typename Predicate>
  bool any_in_leaf(const Node& leaf, const Triangle& triangle, const Predicate& predicate) {
    for (std::uint32_t i = leaf.begin; i < leaf.end; ++i) {
      const std::uint32_t point = order_[i];
      ++work_;
      if (!is_marked_[point]) continue;
      const glm::dvec2& p = points_[point];
      const bool is_inside = turn(triangle[0], triangle[1], p) >= 0 && turn(triangle[1], triangle[2], p) >= 0 &&
                             turn(triangle[2], triangle[0], p) >= 0;
      if (is_inside && predicate(point)) return true;
    }
    return false;
  }

  void build_node(std::uint32_t index, std::uint32_t begin, std::uint32_t end);

  std::span<const glm::dvec2> points_;
  std::vector<Node> nodes_;
  std::uint32_t first_leaf_ = 0;
  std::vector<std::uint32_t> order_;    // points, those of a leaf side by side
  std::vector<std::uint32_t> leaf_of_;  // of each point
  std::vector<bool> is_marked_;
  std::size_t work_ = 0;
};

}  // namespace lkao::scene
