// The caller's target of occlusion, for any pass.
#include "gpu/frame/target_block.h"
#include "gpu/frame/units.h"

layout(binding = LKAO_IMAGE_TARGET) writeonly uniform image2D target_image;
layout(binding = LKAO_UNIT_TARGET) uniform sampler2D target_texels;

ivec2 target_texel(ivec2 pixel) { return ivec2(target.first_x, target.first_y) + pixel; }

// Stores of normalised numbers may round to the nearest or cut off (NVIDIA's do): either finds this step.
vec4 at_nearest_step(vec4 texel, vec4 steps) {
  return mix((floor(texel * steps + 0.5) + 0.25) / max(steps, 1.0), texel, equal(steps, vec4(0)));
}

void write_value(ivec2 pixel, float value) {
  ivec2 place = target_texel(pixel);
  vec4 texel = vec4(value, 0, 0, 1);
  if (target.keeps_others != 0) {
    texel = texelFetch(target_texels, place, 0);
    texel[target.channel] = value;
  }
  imageStore(target_image, place, at_nearest_step(texel, target.steps));
}

// Once a pixel: what others have written to it is not read again.
void write_occlusion(ivec2 pixel, float occlusion) {
  write_value(pixel, target.is_visibility != 0 ? 1.0 - occlusion : occlusion);
}

void write_background(ivec2 pixel) { write_value(pixel, target.background); }
