// The vector kernel on a scene of many instances.
#pragma once

#include <cstdint>

#include "bvh/query.h"
#include "bvh/scene_layout.h"

namespace lkao::bvh {

// Which of the cast rays are blocked: equal to trace_scalar bit for bit on every SIMD target. Once through the nodes
// over the instances with all rays, then, for each instance that some of them may meet, through its mesh's hierarchy
// with those. Allocates nothing; any thread.
OcclusionMask trace_simd(const SceneLayout& scene, const Query& query);

// Which of the rays `open` of the query one instance blocks, whatever its groups.
OcclusionMask trace_instance(const SceneLayout& scene, const Query& query, std::uint32_t instance,
                             const OcclusionMask& open);

// Lists the open rays of a query of an instance in the space of its mesh, one behind the other, each cut where it is
// `reach` long, or somewhat behind. Returns the length of the longest.
float turn_open_rays(const Query& world, float reach, ReceiverRays& to);

}  // namespace lkao::bvh
