#version 450 core
// For the self-test: how often each pixel is drawn.
#include "pass.glsl"

layout(std430, binding = LKAO_STORAGE_MASKS) buffer Counts { uint counts[]; };

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  atomicAdd(counts[pixel.y * pass.extent.x + pixel.x], 1u);
}
