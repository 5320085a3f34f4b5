#include "bvh/surface_area.h"

#include <algorithm>
#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "bvh/bounds.h"

namespace lkao::bvh {
namespace {

SurfaceAreas sum(SurfaceAreas a, const SurfaceAreas& b) {
  a.root += b.root;
  a.nodes += b.nodes;
  a.leaves += b.leaves;
  a.triangles += b.triangles;
  return a;
}

void add_children(const Node& node, const Layout& layout, SurfaceAreas& areas) {
  for (int i = 0; i < kWidth && !node.children[i].is_empty(); ++i) {
    if (node.is_unreachable(i)) continue;
    const double area = half_area(node.child_bounds(i));
    if (!node.children[i].is_leaf()) {
      areas.nodes += area;
      continue;
    }
    areas.leaves += area;
    const Leaf& leaf = layout.leaves[node.children[i].index()];
    for (int triangle = 0; triangle < leaf.triangle_count(); ++triangle) {
      areas.triangles += half_area(bounds_of(layout.mesh.corners(leaf.primitives[triangle])));
    }
  }
}

}  // namespace

SurfaceAreas surface_areas(const Layout& layout) {
  if (is_nowhere(layout.bounds)) return {};
  using Range = tbb::blocked_range<std::size_t>;
  SurfaceAreas areas = tbb::parallel_deterministic_reduce(
      Range(0, layout.nodes.size(), 256), SurfaceAreas(),
      [&](const Range& range, SurfaceAreas part) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) add_children(layout.nodes[i], layout, part);
        return part;
      },
      sum);
  areas.root = half_area(layout.bounds);
  return areas;
}

double surface_area_cost(const SurfaceAreas& areas) {
  return areas.root > 0 ? 1 + (areas.nodes + areas.leaves) / areas.root : 0;
}

// What a hierarchy built anew would have is not known. Leaves grow with their triangles. Nodes grow with the scene
// where all of it does; where triangles alone do, by shaking, or the bounds alone, by a part that flies away, they
// stay.
double growth(const SurfaceAreas& now, const SurfaceAreas& built) {
  if (!(now.root > 0 && built.root > 0)) return 1;
  const double of_triangles = now.triangles / built.triangles;
  const double of_nodes = std::min(of_triangles, now.root / built.root);
  return (now.nodes + now.leaves) / (of_nodes * built.nodes + of_triangles * built.leaves);
}

}  // namespace lkao::bvh
