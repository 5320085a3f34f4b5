#version 450 core
// Depths of the receivers for the inverted depth test (Laine & Karras 2010, Sec. 4, step 3c).
#include "gpu/masks/units.h"
#include "gpu/mesh/depth.glsl"

layout(binding = LKAO_UNIT_RECEIVERS) uniform sampler2DArray receivers;

void main() {
  float along_view = texelFetch(receivers, ivec3(ivec2(gl_FragCoord.xy), LKAO_RECEIVER_ORIGIN), 0).w;
  // 0, the far end, where there is no receiver: nothing is less.
  gl_FragDepth = along_view > 0.1 * LKAO_NO_RECEIVER ? receiver_depth(along_view) : 0.0;
}
