#version 450 core
// For the check of the driver: how often each pixel is drawn.
#include "gpu/frame/view.glsl"

layout(std430, binding = 0) buffer Counts { uint counts[]; };

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  atomicAdd(counts[pixel.y * view.width + pixel.x], 1u);
}
