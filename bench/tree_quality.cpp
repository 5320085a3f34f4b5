#include "bench/tree_quality.h"

#include <cstdint>
#include <ctime>
#include <vector>

#include "bvh/layout.h"

namespace lkao::bench {
namespace {

double half_area(const Bounds& box) {
  const glm::dvec3 size = glm::dvec3(box.upper) - glm::dvec3(box.lower);
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

}  // namespace

TreeQuality tree_quality(const OccluderBvh& occluders) {
  const double root_area = half_area(occluders.bounds());
  double nodes = 1, leaves = 0;
  for (const bvh::Node& node : occluders.layout().nodes) {
    for (int i = 0; i < bvh::kWidth && !node.children[i].is_empty(); ++i) {
      (node.children[i].is_leaf() ? leaves : nodes) += half_area(node.child_bounds(i)) / root_area;
    }
  }
  return {occluders.report().node_count, occluders.report().reference_count, nodes, leaves};
}

double query_cpu_seconds(const OccluderBvh& occluders, std::span<const Receiver> receivers, float radius) {
  const SamplePattern& pattern = SamplePattern::standard(128);
  const AmbientOcclusion ao(occluders, pattern, {.radius = radius});
  std::vector<std::uint64_t> masks(receivers.size() * static_cast<std::size_t>(pattern.word_count()));
  const std::clock_t start = std::clock();
  ao.query(receivers, {.mask_words = masks});
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

}  // namespace lkao::bench
