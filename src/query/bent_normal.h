// Where the open part of a receiver's hemisphere lies.
#pragma once

#include <glm/geometric.hpp>

#include "lkao/ambient_occlusion.h"

namespace lkao::query {

// Mean direction of the cast rays that are not blocked, a unit vector; `normal`, normalised, where none is left.
inline glm::vec3 bent_normal(const ReceiverRays& rays, const OcclusionMask& blocked, const glm::vec3& normal) {
  glm::dvec3 sum(0);
  for (int i = 0; i < rays.ray_count; ++i) {
    if (rays.cast.test(i) && !blocked.test(i)) sum += glm::dvec3(rays.directions[i]);
  }
  return glm::normalize(sum == glm::dvec3(0) ? glm::dvec3(normal) : sum);
}

}  // namespace lkao::query
