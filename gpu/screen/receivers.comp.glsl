#version 450 core
// From the G-buffer to the receivers that passes in screen space read (gpu/screen/receivers.glsl).
#define LKAO_DOUBLE 0
#include "gpu/screen/surface.glsl"
#include "gpu/screen/units.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32f) writeonly uniform image2DArray receivers;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (is_outside(pixel)) return;
  Surface surface;
  bool is_there = find_surface(pixel, surface);
  imageStore(receivers, ivec3(pixel, LKAO_SCREEN_POSITION), is_there ? vec4(surface.position, 1) : vec4(0));
  imageStore(receivers, ivec3(pixel, LKAO_SCREEN_NORMAL), is_there ? vec4(surface.normal, 0) : vec4(0));
}
