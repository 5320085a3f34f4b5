// What a sphere blocks of a receiver (SphereFormula).
//
// Based on: P. Shanmugam, O. Arikan, "Hardware Accelerated Ambient Occlusion Techniques on GPUs", I3D 2007, Sec. 3.
#include "gpu/screen/splat/splat_block.h"

// `squared_sine`: (r / d)^2, at most 1. `cosine`: of the direction to the centre from the receiver's normal, above 0.
float sphere_occlusion(float squared_sine, float cosine) {
  // Eq. 3: 2 pi (1 - cos asin(r / d)), written so that small spheres keep their digits; Eq. 2; over pi (Eq. 1), unless
  // the scale takes it back.
  float cap = 2.0 * squared_sine / (1.0 + sqrt(max(1.0 - squared_sine, 0.0)));
  return pass.scale * (pass.is_exact != 0 ? squared_sine : cap) * cosine;
}
