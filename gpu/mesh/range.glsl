// At which distances a triangle counts: level of detail.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 4.3.
#include "gpu/mesh/shapes.glsl"

layout(binding = LKAO_UNIT_RANGES) uniform samplerBuffer ranges;

// r_min, no less than where rays begin to count, and r_max, no more than the AO radius. Empty where r_min is not less.
vec2 range_of(uint triangle) {
  if (shapes.has_ranges == 0) return vec2(shapes.min_distance, ao_radius());
  vec2 range = texelFetch(ranges, int(triangle)).xy;
  return vec2(max(range.x, shapes.min_distance), min(range.y, ao_radius()));
}
