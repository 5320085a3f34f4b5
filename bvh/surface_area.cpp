#include "bvh/surface_area.h"

#include <cstddef>
#include <functional>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>
#include <glm/vec3.hpp>

#include "bvh/bounds.h"

namespace lkao::bvh {
namespace {

double half_surface(const Bounds& box) {
  const glm::dvec3 size = glm::dvec3(box.upper) - glm::dvec3(box.lower);
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

// Of the children that rays may meet.
double area_of_children(const Node& node) {
  double sum = 0;
  for (int i = 0; i < kWidth && !node.children[i].is_empty(); ++i) {
    if (!node.is_unreachable(i)) sum += half_surface(node.child_bounds(i));
  }
  return sum;
}

}  // namespace

double surface_area_cost(const Layout& layout) {
  if (is_nowhere(layout.bounds)) return 0;
  using Range = tbb::blocked_range<std::size_t>;
  const double sum = tbb::parallel_deterministic_reduce(
      Range(0, layout.nodes.size(), 1024), 0.0,
      [&](const Range& range, double part) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) part += area_of_children(layout.nodes[i]);
        return part;
      },
      std::plus<>());
  return 1 + sum / half_surface(layout.bounds);
}

}  // namespace lkao::bvh
