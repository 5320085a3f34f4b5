// Where occluders and receivers are, for an infinite AO radius: the finite one that stands for it, and the depth scale
// that goes with it, as ShapesBlock has them.
#include "gpu/mesh/units.h"

layout(std430, binding = LKAO_STORAGE_EXTENT) buffer Extent {
  uint sides[12];  // as `ordered`, of the occluders' bounds: x, y, z at most, -x, -y, -z at most; then of the origins'
  float unbounded_radius;
  float unbounded_depth_scale;
};

const int kOccluders = 0, kOrigins = 6;  // the first side of each

// Floats as integers of the same order, all above 0.
uint ordered(float x) {
  uint bits = floatBitsToUint(x);
  return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

float side(int i) {
  return uintBitsToFloat((sides[i] & 0x80000000u) != 0u ? sides[i] & 0x7fffffffu : ~sides[i]);
}

void widen(int i, float x) {
  // Few points widen the bounds, and atomics are slow; an old value read here does no harm.
  if (ordered(x) > sides[i]) atomicMax(sides[i], ordered(x));
}

void include_point(int first_side, vec3 point) {
  for (int axis = 0; axis < 3; ++axis) {
    widen(first_side + axis, point[axis]);
    widen(first_side + 3 + axis, -point[axis]);
  }
}
