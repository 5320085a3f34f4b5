#version 450 core
// One fragment: what a triangle takes from the accessibility of the pixel's receiver. Variants: LKAO_TWO_HORIZONS,
// receivers have geometric normals of their own; LKAO_COUNT.
//
// Based on: M. McGuire, "Ambient Occlusion Volumes", HPG 2010, Sec. 5, step 4.iv.
#define VARYING in
#include "gpu/volumes/varyings.glsl"
#include "gpu/gl/fragment_counters.glsl"
#include "gpu/mesh/shapes.glsl"
#include "gpu/volumes/falloff.glsl"
#include "gpu/volumes/form_factor.glsl"
#include "gpu/volumes/units.h"
#include "gpu/volumes/volume_pass_block.h"

layout(binding = LKAO_UNIT_ORIGINS) uniform sampler2D origins;
layout(binding = LKAO_UNIT_AXES) uniform sampler2D axes;
#if LKAO_TWO_HORIZONS
layout(binding = LKAO_UNIT_UPS) uniform sampler2D ups;
#endif

layout(location = 0) out float taken;  // is subtracted

#define COUNT_DRAWN COUNT_0
#define COUNT_INSIDE COUNT_1
#define COUNT_BLENDED COUNT_2

#if LKAO_COUNT
// Atomics must not run for fragments that fail the depth test.
layout(early_fragment_tests) in;
#endif

bool is_left(vec3 from, vec3 to, vec3 point) { return dot(cross(to - from, point - from), shape.normal) >= 0.0; }

// Where corners are clamped the volume ends before the falloff does, and only its far side is drawn.
bool is_over_base(vec3 point) {
  return is_left(shape.base_a, shape.base_b, point) && is_left(shape.base_b, shape.base_c, point) &&
         is_left(shape.base_c, shape.base_a, point);
}

void main() {
  COUNT_DRAWN;
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  // The receiver becomes the origin.
  vec3 receiver = texelFetch(origins, pixel, 0).xyz;
  vec3 a = shape.a - receiver, b = shape.b - receiver, c = shape.c - receiver, normal = shape.normal;
  float height = -dot(normal, a);
  if (height < 0.0 && is_two_sided()) {
    // From behind it is the same triangle the other way round.
    vec3 swapped = b;
    b = c;
    c = swapped;
    normal = -normal;
    height = -height;
  }
  if (height <= 0.0) discard;
  float g = shape.opacity * falloff(a, b, c, normal, ao_radius());
  if (g <= 0.0 || (pass.clamps_extensions != 0 && !is_over_base(receiver))) discard;
  COUNT_INSIDE;
  vec4 axis = texelFetch(axes, pixel, 0);
  Polygon polygon = above(triangle_of(a, b, c), axis.xyz);
#if LKAO_TWO_HORIZONS
  if (polygon.count > 0) polygon = above(polygon, texelFetch(ups, pixel, 0).xyz);
#endif
  if (polygon.count == 0) discard;
  COUNT_BLENDED;
  taken = g * form_factor(polygon, axis.xyz) / axis.w;
}
