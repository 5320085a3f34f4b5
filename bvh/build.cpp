#include "bvh/build.h"

#include <chrono>
#include <limits>
#include <utility>

#include <glm/common.hpp>

#include "bvh/flatten.h"
#include "bvh/split_builder.h"
#include "bvh/usable_triangle.h"
#include "lut/coordinates.h"

namespace lkao::bvh {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Sorts the triangles of the mesh into those the builder gets and those that are dropped and counted.
Pieces collect_occluders(std::size_t capacity, bool keep_zero_area, Layout& layout) {
  const PackedMesh& mesh = layout.mesh;
  Pieces pieces;
  pieces.reserve(capacity);
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::vec3 &a = mesh.corner(i, 0), &b = mesh.corner(i, 1), &c = mesh.corner(i, 2);
    if (!lut::is_in_range(a, b, c)) {
      ++layout.report.non_finite_count;
      continue;
    }
    const bool has_area = !has_zero_area(a, b, c);
    if (!has_area) ++layout.report.zero_area_count;
    if (has_area || keep_zero_area) {
      const glm::vec3 lower = glm::min(a, glm::min(b, c)), upper = glm::max(a, glm::max(b, c));
      pieces.emplace_back(Box{{lower.x, lower.y, lower.z, 0}, {upper.x, upper.y, upper.z, 0}}, i);
      layout.bounds = {glm::min(layout.bounds.lower, lower), glm::max(layout.bounds.upper, upper)};
    }
  }
  layout.report.triangle_count = mesh.triangles.size();
  layout.report.occluder_count = mesh.triangles.size() - layout.report.zero_area_count - layout.report.non_finite_count;
  return pieces;
}

template <typename Vector>
std::size_t size_in_bytes(const Vector& values) {
  return values.size() * sizeof(values[0]);
}

}  // namespace

std::shared_ptr<const Layout> build(const TriangleMesh& mesh, const BuildOptions& options, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  auto layout = std::make_shared<Layout>();
  layout->bounds = {glm::vec3(kInfinity), glm::vec3(-kInfinity)};
  layout->mesh = pack(mesh);
  SplitBuilder builder(layout->mesh, options.spatial_splits);
  Pieces pieces = collect_occluders(builder.capacity_for(mesh.triangles.size()), options.keep_zero_area, *layout);
  if (pieces.empty()) {
    layout->mesh = {};  // no query asks for it
  } else {
    const BuildTree& tree = builder.build(std::move(pieces), progress);
    flatten(tree, *layout);
    layout->report.reference_count = tree.size.reference_count;
  }
  layout->report.node_count = layout->nodes.size();
  layout->report.memory_bytes = size_in_bytes(layout->nodes) + size_in_bytes(layout->leaves) +
                                size_in_bytes(layout->mesh.positions) + size_in_bytes(layout->mesh.triangles);
  layout->report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
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
