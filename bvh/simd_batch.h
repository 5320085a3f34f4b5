// The vector kernel on a scene of many instances, for several receivers at once.
#pragma once

#include <span>

#include "bvh/query.h"
#include "bvh/scene_layout.h"

namespace lkao::bvh {

inline constexpr int kMaxBatchReceivers = 64;
inline constexpr int kMaxBatchRays = 8192;

// How many receivers of so many rays each may be answered at once.
constexpr int max_batch_receivers(int ray_count) {
  const int filled = 64 * word_count_of(ray_count);
  return filled * kMaxBatchReceivers < kMaxBatchRays ? kMaxBatchReceivers : kMaxBatchRays / filled;
}

// Which of their open rays are blocked: equal to trace_simd for each query by itself. All have as many rays and the
// same roots, sidedness and no parts; neighbours gain most. Rays go through the nodes over the instances together, and
// the few of each receiver that may meet an instance go through its mesh's hierarchy with those of the others.
// Allocates some 600 KiB; any thread.
void trace_batch(const SceneLayout& scene, std::span<const Query> queries, std::span<OcclusionMask> blocked);

}  // namespace lkao::bvh
