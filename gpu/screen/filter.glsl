// What the cross-bilateral filter knows of a pixel, and how it weighs another (include/lkao/gl/bilateral_filter.h).
#define LKAO_DOUBLE 0
#include "gpu/screen/filter_block.h"
#include "gpu/screen/surface.glsl"
#include "gpu/screen/units.h"

layout(binding = LKAO_UNIT_UNFILTERED) uniform sampler2D unfiltered;

// How much a surface belongs to that in the middle, whose pixels are so wide there.
float likeness(Surface middle, Surface other, float width) {
  float off_plane = dot(middle.normal, other.position - middle.position) / (pass.depth_tolerance * width);
  float alike =
      pass.normal_sharpness > 0.0 ? pow(max(dot(middle.normal, other.normal), 0.0), pass.normal_sharpness) : 1.0;
  return exp(-off_plane * off_plane) * alike;
}

float read_occlusion(ivec2 place) {
  float value = texelFetch(unfiltered, ivec2(pass.source_x, pass.source_y) + place, 0)[pass.source_channel];
  return pass.source_is_visibility != 0 ? 1.0 - value : value;
}
