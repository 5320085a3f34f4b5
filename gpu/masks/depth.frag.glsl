#version 450 core
// Depths of the receivers for the inverted depth test (Laine & Karras 2010, Sec. 4, step 3c).
#include "gpu/masks/units.h"
#include "gpu/mesh/depth.glsl"

layout(binding = LKAO_UNIT_RECEIVERS) uniform sampler2DArray receivers;

void main() {
  float along_view = texelFetch(receivers, ivec3(ivec2(gl_FragCoord.xy), LKAO_RECEIVER_ORIGIN), 0).w;
  // 0, the far end, where there is no receiver: nothing is less.
  float depth = 0.0;
  if (along_view > 0.1 * LKAO_NO_RECEIVER) {
    // A little nearer, for interpolated depths are off by some 1e-4 (occluder.glsl limits their range to 1000).
    float nearer = along_view - 1e-3 * (abs(along_view) + ao_radius());
    depth = is_perspective() && nearer <= 0.0 ? 1.0 : depth_at(nearer);
  }
  gl_FragDepth = clamp(depth, 0.0, 1.0);
}
