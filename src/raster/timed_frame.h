// What the drawing classes of this folder do alike.
#pragma once

#include <epoxy/gl.h>

#include <chrono>

#include "lkao/receiver.h"

namespace lkao::raster {

// The seconds of `draw` on the GPU, with nothing else under way.
template <typename Draw>
double seconds_of(const Draw& draw) {
  using Clock = std::chrono::steady_clock;
  glFinish();
  const Clock::time_point start = Clock::now();
  draw();
  glFinish();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// ViewTextures have the receivers as they are: they start where the query's do.
inline RayOptions from_exact_receivers(RayOptions options) {
  if (options.surface_offset == kAutomaticSurfaceOffset) options.surface_offset = kQuerySurfaceOffset;
  return options;
}

}  // namespace lkao::raster
