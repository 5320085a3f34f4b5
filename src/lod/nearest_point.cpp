#include "lod/nearest_point.h"

#include <algorithm>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace lkao::lod {
namespace {

int longest_axis(const glm::dvec3& size) {
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

}  // namespace

NearestPoint::NearestPoint(std::span<const glm::dvec3> points) {
  nodes_.reserve(points.size());
  for (const glm::dvec3& point : points) nodes_.push_back({point, static_cast<std::uint32_t>(nodes_.size()), 0});
  arrange(0, nodes_.size());
}

void NearestPoint::arrange(std::size_t first, std::size_t last) {
  if (last - first < 2) return;
  glm::dvec3 lower = nodes_[first].point, upper = lower;
  for (std::size_t i = first; i < last; ++i) {
    lower = glm::min(lower, nodes_[i].point);
    upper = glm::max(upper, nodes_[i].point);
  }
  const int axis = longest_axis(upper - lower);
  const std::size_t middle = first + (last - first) / 2;
  const auto at = [&](std::size_t i) { return nodes_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(first), at(middle), at(last),
                   [axis](const Node& a, const Node& b) { return a.point[axis] < b.point[axis]; });
  nodes_[middle].axis = static_cast<std::uint32_t>(axis);
  arrange(first, middle);
  arrange(middle + 1, last);
}

void NearestPoint::search(std::size_t first, std::size_t last, const glm::dvec3& place, Best& best) const {
  if (first == last) return;
  const std::size_t middle = first + (last - first) / 2;
  const Node& node = nodes_[middle];
  const glm::dvec3 off = place - node.point;
  const double squared = glm::dot(off, off);
  if (squared < best.squared_distance || (squared == best.squared_distance && node.index < best.index)) {
    best = {squared, node.index};
  }
  const double across = off[static_cast<int>(node.axis)];
  const bool is_below = across < 0;
  search(is_below ? first : middle + 1, is_below ? middle : last, place, best);
  if (across * across > best.squared_distance) return;
  search(is_below ? middle + 1 : first, is_below ? last : middle, place, best);
}

std::uint32_t NearestPoint::to(const glm::dvec3& place) const {
  Best best{std::numeric_limits<double>::infinity(), 0};
  search(0, nodes_.size(), place, best);
  return best.index;
}

}  // namespace lkao::lod
