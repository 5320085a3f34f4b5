#version 450 core
// The AO radius that stands for an infinite one: a power of two, so that rays keep their digits, beyond all occluders
// as seen from all receivers. No larger than it need be by much, since rounding is counted as a share of the radius.
#include "gpu/mesh/extent.glsl"

layout(local_size_x = 1) in;

void main() {
  float farthest = 0.0;  // along an axis
  bool has_both = sides[kOccluders] != 0u && sides[kOrigins] != 0u;
  for (int axis = 0; axis < 3 && has_both; ++axis) {
    farthest = max(farthest, max(side(kOccluders + axis) + side(kOrigins + 3 + axis),
                                 side(kOrigins + axis) + side(kOccluders + 3 + axis)));
  }
  // The root of three, with room for rounding; the next power of two is at most twice that.
  uint exponent = floatBitsToUint(1.75 * farthest) & 0x7f800000u;
  unbounded_radius = farthest > 0.0 ? uintBitsToFloat(exponent + 0x00800000u) : 1.0;
  unbounded_depth_scale = unbounded_radius / 1024.0;
}
