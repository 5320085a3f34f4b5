// RayOptions checked: one place for the query and the OpenGL passes.
#pragma once

#include <algorithm>

#include "lkao/export.h"
#include "lkao/plane_mask_table.h"
#include "lkao/receiver.h"
#include "lut/require.h"

namespace lkao::lut {

// Throws std::invalid_argument where an option is out of its range.
LKAO_API void check(const RayOptions& options);

// Throws the same where the radius is infinite and the table's rays are not all as long as it.
LKAO_API void check(const RayOptions& options, const PlaneMaskTable& table);

inline bool has_automatic_offset(const RayOptions& options) {
  return options.surface_offset == kAutomaticSurfaceOffset;
}

// How far rays start off the surface, in units of the largest coordinate in play (RayOptions::surface_offset). An
// automatic offset is at least this.
inline float relative_surface_offset(const RayOptions& options) {
  return (has_automatic_offset(options) ? kQuerySurfaceOffset : options.surface_offset) * 0x1p-24f;
}

// The largest tilt of a pattern whose lowest ray is at that elevation: a tenth of it stays, so that rounding cannot use
// it up.
inline float largest_tilt(const Jitter& jitter, float lowest_elevation) {
  return std::min(jitter.tilt, 0.9f * lowest_elevation);
}

}  // namespace lkao::lut
