#version 450 core
// From accessibility to occlusion, perhaps compensated.
//
// Based on: M. McGuire, "Ambient Occlusion Volumes", HPG 2010, Sec. 5.4.
#include "gpu/frame/target.glsl"
#include "gpu/frame/view.glsl"
#include "gpu/volumes/units.h"
#include "gpu/volumes/volume_pass_block.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = LKAO_UNIT_ORIGINS) uniform sampler2D origins;
layout(binding = LKAO_UNIT_ACCESSIBILITY) uniform sampler2D accessibility;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (is_outside(pixel)) return;
  if (texelFetch(origins, pixel, 0).w == 0.0) {
    write_background(pixel);
    return;
  }
  // Floats do not saturate by themselves.
  float o = clamp(1.0 - texelFetch(accessibility, pixel, 0).x, 0.0, 1.0);
  float compensated = o * (pass.compensation.x + o * (pass.compensation.y + o * pass.compensation.z));
  write_occlusion(pixel, clamp(compensated, 0.0, 1.0));
}
