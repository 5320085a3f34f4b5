#include "bvh/refit.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "bvh/bounds.h"
#include "bvh/box_margin.h"
#include "bvh/build.h"
#include "bvh/leaf.h"
#include "bvh/surface_area.h"
#include "lut/progress_sum.h"
#include "lut/require.h"

namespace lkao::bvh {
namespace {

// Bottom up: leaves are made anew, and boxes hold what their children hold. Each part of the tree is filled by one
// task, so that the result is the same on any number of threads.
class Refitter {
 public:
  // `layout` has its mesh already, and room for as many nodes and leaves as `old`.
  Refitter(const Layout& old, Layout& layout, lut::ProgressSum& sum) : old_(old), layout_(layout), sum_(sum) {}

  struct Subtree {
    Bounds bounds = kNowhere;
    std::uint32_t leaf_count = 0;
  };

  Subtree fill_all() {
    const auto node_count = static_cast<std::uint32_t>(old_.nodes.size());
    const Subtree all = fill_node(0, node_count);
    if (!is_worth_tasks(node_count)) sum_.add(all.leaf_count);
    return all;
  }

  // In the order of leaves.
  std::vector<RestingTriangle> resting() const {
    std::vector<RestingTriangle> all;
    for (const std::vector<RestingTriangle>& some : resting_) all.insert(all.end(), some.begin(), some.end());
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  static bool is_worth_tasks(std::uint32_t node_count) { return node_count >= 64; }

  // A node, and those below it, which come next, up to `end`.
  Subtree fill_node(std::uint32_t index, std::uint32_t end) {
    const Node& from = old_.nodes[index];
    int child_count = 0;
    while (child_count < kWidth && !from.children[child_count].is_empty()) ++child_count;
    std::uint32_t ends[kWidth];
    for (int i = child_count, next = static_cast<int>(end); i-- > 0;) {
      ends[i] = static_cast<std::uint32_t>(next);
      if (!from.children[i].is_leaf()) next = static_cast<int>(from.children[i].index());
    }
    Subtree children[kWidth];
    const bool has_tasks = is_worth_tasks(end - index);
    const auto fill_child = [&](int i) {
      const ChildRef child = from.children[i];
      children[i] = child.is_leaf() ? Subtree{fill_leaf(child.index()), 1} : fill_node(child.index(), ends[i]);
      const bool is_small = child.is_leaf() || !is_worth_tasks(ends[i] - child.index());
      if (has_tasks && is_small) sum_.add(children[i].leaf_count);
    };
    if (has_tasks) {
      tbb::parallel_for(0, child_count, fill_child);
    } else {
      for (int i = 0; i < child_count; ++i) fill_child(i);
    }
    Node& to = layout_.nodes[index];
    to = Node::empty();
    Subtree all;
    for (int i = 0; i < child_count; ++i) {
      all.bounds = merge(all.bounds, children[i].bounds);
      all.leaf_count += children[i].leaf_count;
      if (is_nowhere(children[i].bounds)) {
        to.set_unreachable(i, from.children[i]);
      } else {
        to.set_child(i, with_margin(children[i].bounds), from.children[i]);
      }
    }
    return all;
  }

  Bounds fill_leaf(std::uint32_t index) {
    std::uint32_t primitives[kLeafWidth];
    const int count = triangles_of(index, primitives);
    Bounds bounds = kNowhere;
    std::uint32_t* end = primitives;  // of those that are of use
    for (int i = 0; i < count; ++i) {
      const std::uint32_t primitive = primitives[i];
      const Corners corners = layout_.mesh.corners(primitive);
      if (!is_kept(defect_of(corners), layout_.options)) {
        resting_.local().push_back({index, primitive});
        continue;
      }
      bounds = merge(bounds, bounds_of(corners));
      *end++ = primitive;
    }
    if (end == primitives) ++end;  // a leaf that nothing reaches holds something as well
    layout_.leaves[index] = make_leaf(layout_.mesh, {primitives, end}, layout_.options.cut_outs, layout_.grids.get());
    return bounds;
  }

  // Of a leaf, also those that rest. Returns how many.
  int triangles_of(std::uint32_t leaf, std::uint32_t (&primitives)[kLeafWidth]) const {
    const Leaf& from = old_.leaves[leaf];
    std::uint32_t* end = std::copy_n(from.primitives, from.triangle_count(), primitives);
    const auto first = std::lower_bound(old_.resting.begin(), old_.resting.end(), RestingTriangle{leaf, 0});
    for (auto rests = first; rests != old_.resting.end() && rests->leaf == leaf; ++rests) {
      if (std::find(primitives, end, rests->primitive) == end) *end++ = rests->primitive;
    }
    return static_cast<int>(end - primitives);
  }

  const Layout& old_;
  Layout& layout_;
  lut::ProgressSum& sum_;
  tbb::enumerable_thread_specific<std::vector<RestingTriangle>> resting_;
};

// Each triangle once that may be of no use: those that are dropped or rest, or all of them.
std::vector<std::uint32_t> doubtful_triangles(const Layout& layout) {
  std::vector<std::uint32_t> primitives;
  if (layout.options.keep_zero_area) {
    primitives.resize(layout.report.triangle_count);
    std::iota(primitives.begin(), primitives.end(), 0u);
    return primitives;
  }
  primitives = layout.dropped;
  primitives.reserve(primitives.size() + layout.resting.size());
  for (const RestingTriangle& resting : layout.resting) primitives.push_back(resting.primitive);
  std::sort(primitives.begin(), primitives.end());
  primitives.erase(std::unique(primitives.begin(), primitives.end()), primitives.end());
  return primitives;
}

void count_unusable(Layout& layout) {
  BuildReport& report = layout.report;
  report.zero_area_count = report.non_finite_count = 0;
  for (const std::uint32_t primitive : doubtful_triangles(layout)) {
    const Defect defect = defect_of(layout.mesh.corners(primitive));
    if (defect == Defect::zero_area) ++report.zero_area_count;
    if (defect == Defect::non_finite) ++report.non_finite_count;
  }
  report.occluder_count = report.triangle_count - report.zero_area_count - report.non_finite_count;
}

// Null where a triangle that no leaf has is of use now.
std::shared_ptr<Layout> refit_topology(const Layout& old, const PositionView& positions, const Progress& progress) {
  auto layout = std::make_shared<Layout>();
  layout->mesh = moved(old.mesh, positions);
  const auto is_of_use = [&](std::uint32_t primitive) {
    return is_kept(defect_of(layout->mesh.corners(primitive)), old.options);
  };
  if (std::any_of(old.dropped.begin(), old.dropped.end(), is_of_use)) return nullptr;
  layout->bounds = kNowhere;
  layout->options = old.options;
  layout->grids = old.grids;
  layout->built = old.built;
  layout->dropped = old.dropped;
  layout->report = old.report;
  layout->nodes.resize(old.nodes.size());
  layout->leaves.resize(old.leaves.size());
  if (!old.nodes.empty()) {
    lut::ProgressSum sum(progress, old.leaves.size());
    Refitter refitter(old, *layout, sum);
    layout->bounds = refitter.fill_all().bounds;
    layout->resting = refitter.resting();
  }
  count_unusable(*layout);
  BuildReport& report = layout->report;
  report.reference_count = old.report.reference_count + old.resting.size() - layout->resting.size();
  report.memory_bytes = memory_bytes(*layout);
  const SurfaceAreas areas = surface_areas(*layout);
  report.surface_area_cost = surface_area_cost(areas);
  report.growth = growth(areas, layout->built);
  return layout;
}

}  // namespace

std::shared_ptr<const Layout> refit(const Layout& old, const PositionView& positions, const RefitOptions& options,
                                    const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  lut::require(options.max_growth >= 1, "max_growth", "at least 1", options.max_growth);
  if (positions.size() != old.mesh.position_count()) {
    throw std::invalid_argument(fmt::format("there must be {} positions, as at the build, not {}",
                                            old.mesh.position_count(), positions.size()));
  }
  std::shared_ptr<Layout> layout = refit_topology(old, positions, progress);
  if (layout == nullptr || layout->report.growth > options.max_growth) {
    layout.reset();  // not two at a time
    layout = build({positions, old.mesh.triangle_view()}, old.options, progress);
  }
  layout->report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return layout;
}

}  // namespace lkao::bvh

namespace lkao {

OccluderBvh OccluderBvh::refitted(const PositionView& positions, const RefitOptions& options,
                                  const Progress& progress) const {
  return OccluderBvh(Finished(), bvh::refit(*layout_, positions, options, progress));
}

}  // namespace lkao
