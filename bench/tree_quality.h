// How good a finished hierarchy is, whatever it took to build.
#pragma once

#include <cstddef>
#include <span>

#include "lkao/lkao.h"

namespace lkao::bench {

struct TreeQuality {
  std::size_t node_count, reference_count;
  // The surface area heuristic: nodes and leaves that a long ray through the scene's bounds is expected to visit.
  double visited_nodes, visited_leaves;
};

TreeQuality tree_quality(const OccluderBvh& occluders);

// Processor time of one batch of 128 rays each, on the threads of the caller's TBB arena.
double query_cpu_seconds(const OccluderBvh& occluders, std::span<const Receiver> receivers, float radius);

}  // namespace lkao::bench
