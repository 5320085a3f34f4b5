// The scalar exact kernel: the readable definition of a query's result.
#pragma once

#include "bvh/layout.h"
#include "lkao/ambient_occlusion.h"

namespace lkao::bvh {

// What a receiver asks of the hierarchy.
struct Query {
  const ReceiverRays& rays;
  glm::vec3 up;  // geometric normal, unit length: no cast ray goes below its horizon
  float radius = 0;
  Sidedness sidedness = Sidedness::two_sided;
  std::uint32_t excluded_primitive = kNoPrimitive;
};

// Which of the cast rays are blocked. Allocates nothing; any thread.
OcclusionMask trace_scalar(const Layout& layout, const Query& query);

}  // namespace lkao::bvh
