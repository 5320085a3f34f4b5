// The CPU's answer for receivers as the GPU saw them.
#pragma once

#include "bvh/scalar_kernel.h"
#include "lkao/ambient_occlusion.h"
#include "lkao/gl.h"
#include "query/turn_pattern.h"

namespace lkao::gl::tests {

inline ReceiverRays rays_of(const PixelReceiver& receiver, const query::PatternLanes& lanes, float radius) {
  ReceiverRays rays;
  rays.origin = receiver.origin;
  rays.frame = receiver.frame;
  rays.up = receiver.up;
  rays.ray_count = static_cast<int>(lanes.x.size());
  query::turn_pattern(lanes, receiver.frame, radius, receiver.up, rays);
  return rays;
}

inline OcclusionMask cpu_mask(const OccluderBvh& occluders, const ReceiverRays& rays, float radius,
                              Sidedness sidedness) {
  const bvh::Layout& layout = occluders.layout();
  return bvh::trace_scalar(layout, {layout.roots(), rays, rays.cast, radius, sidedness, kNoPrimitive});
}

}  // namespace lkao::gl::tests
