#version 450 core
// Takes the rays that are not cast out of the masks.
#include "gpu/masks/mask_pass_block.h"
#include "gpu/masks/rays.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32ui) uniform uimage2DArray masks;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (is_outside(pixel)) return;
  if (texelFetch(receivers, ivec3(pixel, LKAO_RECEIVER_ORIGIN), 0).w < 0.1 * LKAO_NO_RECEIVER) return;
  Frame frame = fetch_frame(pixel);
  int ray_count = pass.ray_count;
  for (int layer = 0; layer * 128 < ray_count; ++layer) {
    uvec4 kept = uvec4(0u);
    for (int i = 0; i < min(128, ray_count - layer * 128); ++i) {
      if (is_cast(frame, layer * 128 + i)) kept[i / 32] |= 1u << (i % 32);
    }
    ivec3 place = ivec3(pixel, layer);
    imageStore(masks, place, imageLoad(masks, place) & kept);
  }
}
