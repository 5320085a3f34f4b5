#version 450 core
// From masks to occlusion and bent normals.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Eq. 3.
#include "gpu/frame/target.glsl"
#include "gpu/masks/mask_pass_block.h"
#include "gpu/masks/rays.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = LKAO_UNIT_MASKS) uniform usampler2DArray masks;
layout(binding = LKAO_IMAGE_BENT_NORMALS) writeonly uniform image2D bent_normals;

uint bit_count(uvec4 bits) {
  ivec4 counts = bitCount(bits);
  return uint(counts.x + counts.y + counts.z + counts.w);
}

void write_nothing(ivec2 pixel) {
  if (pass.writes_occlusion != 0) write_background(pixel);
  if (pass.writes_bent_normals != 0) imageStore(bent_normals, target_texel(pixel), vec4(0));
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (is_outside(pixel)) return;
  if (texelFetch(receivers, ivec3(pixel, LKAO_RECEIVER_ORIGIN), 0).w < 0.1 * LKAO_NO_RECEIVER) {
    write_nothing(pixel);
    return;
  }
  Frame frame = fetch_frame(pixel);
  int ray_count = pass.ray_count;
  bool all_are_cast = view.has_geometric_normals == 0 && pass.jitter_tilt <= 0.0;
  bool needs_rays = pass.writes_bent_normals != 0 || !all_are_cast;
  uint blocked_count = 0u, cast_count = all_are_cast ? uint(ray_count) : 0u;
  vec3 open_sum = vec3(0);
  for (int layer = 0; layer * 128 < ray_count; ++layer) {
    uvec4 blocked = texelFetch(masks, ivec3(pixel, layer), 0);
    blocked_count += bit_count(blocked);
    if (!needs_rays) continue;
    for (int i = 0; i < min(128, ray_count - layer * 128); ++i) {
      if (!all_are_cast) {
        if (!is_cast(frame, layer * 128 + i)) continue;
        ++cast_count;
      }
      if ((blocked[i / 32] >> (i % 32) & 1u) == 0u) open_sum += texelFetch(pattern, layer * 128 + i).xyz;
    }
  }
  if (cast_count == 0u) {
    write_nothing(pixel);
    return;
  }
  if (pass.writes_occlusion != 0) write_occlusion(pixel, float(blocked_count) / float(cast_count));
  if (pass.writes_bent_normals != 0) {
    vec3 bent = open_sum == vec3(0) ? frame.z : normalize(ray_direction(frame, open_sum));
    imageStore(bent_normals, target_texel(pixel), vec4(bent, 1));
  }
}
