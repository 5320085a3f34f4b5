#version 450 core
// The sum of both halves, as occlusion.
#include "gpu/frame/target.glsl"
#include "gpu/screen/receivers.glsl"
#include "gpu/screen/splat/splat_block.h"
#include "gpu/screen/splat/units.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = LKAO_UNIT_SPLAT_SUM) uniform sampler2D sum;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (is_outside(pixel)) return;
  if (receiver_position(pixel).w > 0.0) {
    write_occlusion(pixel, min(texelFetch(sum, pixel, 0).x, 1.0));
  } else {
    write_background(pixel);
  }
}
