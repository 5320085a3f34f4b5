#include "bvh/build.h"

#include <chrono>
#include <cstdint>
#include <utility>

#include "bvh/bounds.h"
#include "bvh/cut_outs.h"
#include "bvh/flatten.h"
#include "bvh/split_builder.h"
#include "bvh/surface_area.h"
#include "bvh/usable_triangle.h"

namespace lkao::bvh {
namespace {

// Sorts the triangles of the mesh into those the builder gets and those that are dropped and counted.
Pieces collect_occluders(std::size_t triangle_count, std::size_t capacity, Layout& layout) {
  BuildReport& report = layout.report;
  Pieces pieces;
  pieces.reserve(capacity);
  for (std::uint32_t i = 0; i < triangle_count; ++i) {
    const Corners corners = layout.mesh.corners(i);
    const Defect defect = defect_of(corners);
    if (defect == Defect::zero_area) ++report.zero_area_count;
    if (defect == Defect::non_finite) ++report.non_finite_count;
    if (is_kept(defect, layout.options)) {
      const auto [lower, upper] = bounds_of(corners);
      pieces.emplace_back(Box{{lower.x, lower.y, lower.z, 0}, {upper.x, upper.y, upper.z, 0}}, i);
      layout.bounds = merge(layout.bounds, {lower, upper});
    } else {
      layout.dropped.push_back(i);
    }
  }
  report.triangle_count = triangle_count;
  report.occluder_count = triangle_count - report.zero_area_count - report.non_finite_count;
  return pieces;
}

template <typename Vector>
std::size_t size_in_bytes(const Vector& values) {
  return values.size() * sizeof(values[0]);
}

}  // namespace

std::size_t memory_bytes(const Layout& layout) {
  return size_in_bytes(layout.nodes) + size_in_bytes(layout.leaves) + size_in_bytes(layout.mesh.positions) +
         size_in_bytes(layout.mesh.triangles) + size_in_bytes(layout.dropped) + size_in_bytes(layout.resting) +
         (layout.grids != nullptr ? layout.grids->memory_bytes() : 0);
}

std::shared_ptr<Layout> build(const TriangleMesh& mesh, const BuildOptions& options, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  auto layout = std::make_shared<Layout>();
  layout->bounds = kNowhere;
  check(options.cut_outs, mesh.triangles.size());
  layout->options = options;
  if (options.cut_outs.survey) {
    layout->grids = std::make_shared<const HoleGrids>(options.cut_outs, mesh.triangles.size());
  }
  layout->mesh = pack(mesh, options.mesh_storage);
  const std::size_t triangle_count = mesh.triangles.size();
  SplitBuilder builder(layout->mesh, options.spatial_splits);
  Pieces pieces = collect_occluders(triangle_count, builder.capacity_for(triangle_count), *layout);
  BuildReport& report = layout->report;
  if (!pieces.empty()) {
    const BuildTree& tree = builder.build(std::move(pieces), progress);
    flatten(tree, *layout);
    report.reference_count = tree.size.reference_count;
  }
  report.node_count = layout->nodes.size();
  report.memory_bytes = memory_bytes(*layout);
  layout->built = surface_areas(*layout);
  report.surface_area_cost = surface_area_cost(layout->built);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return layout;
}

}  // namespace lkao::bvh

namespace lkao {

OccluderBvh::OccluderBvh(const TriangleMesh& mesh, const BuildOptions& options, const Progress& progress)
    : layout_(bvh::build(mesh, options, progress)) {}

const BuildReport& OccluderBvh::report() const { return layout_->report; }
const Bounds& OccluderBvh::bounds() const { return layout_->bounds; }
const glm::dvec3& OccluderBvh::origin() const { return layout_->mesh.origin; }

}  // namespace lkao
