// The rays of a receiver that a ray tracer is to cast.
#pragma once

#include <glm/vec3.hpp>

#include "bvh/query.h"
#include "lkao/ambient_occlusion.h"

namespace lkao::reference {

// Calls `visit(ray)` for every ray to cast, in the order of the pattern. A ray without length meets nothing, since
// segments are open at the receiver: Embree has no say in it.
template <typename Visit>
void for_each_cast_ray(const ReceiverRays& rays, const Visit& visit) {
  bvh::for_each_ray(rays.cast, rays.word_count(), [&](int ray) {
    if (rays.ray(ray) != glm::vec3(0)) visit(ray);
  });
}

}  // namespace lkao::reference
