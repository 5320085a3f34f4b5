// Where the open part of a receiver's hemisphere lies.
#pragma once

#include <glm/geometric.hpp>

#include "lkao/ambient_occlusion.h"

namespace lkao::query {

// Mean direction of the cast rays that are not blocked, a unit vector; `normal`, normalised, where none is left.
inline glm::vec3 bent_normal(const SamplePattern& pattern, const ReceiverRays& rays, const OcclusionMask& blocked,
                             const glm::vec3& normal) {
  // Summed in the pattern's space, turned once.
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < pattern.directions().size(); ++i) {
    const int ray = static_cast<int>(i);
    if (rays.cast.test(ray) && !blocked.test(ray)) sum += glm::dvec3(pattern.directions()[i]);
  }
  return glm::normalize(sum == glm::dvec3(0) ? glm::dvec3(normal) : glm::dmat3(rays.frame) * sum);
}

}  // namespace lkao::query
