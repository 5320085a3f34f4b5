// How far off their surfaces receivers start (RayOptions::surface_offset).
#include "gpu/frame/position_error.glsl"
#include "gpu/mesh/shapes.glsl"

layout(binding = LKAO_UNIT_LARGEST) uniform samplerBuffer largest_coordinate;

float largest_component(vec3 v) { return max(abs(v.x), max(abs(v.y), abs(v.z))); }

// Along the unit vector `up`.
float surface_offset(vec3 position, vec3 up) {
  float in_play = max(largest_component(position), texelFetch(largest_coordinate, 0).x);
  precise float offset = shapes.relative_surface_offset * in_play;
  if (shapes.is_offset_automatic != 0) offset += min(error_along(up, position, in_play), largest_added_offset());
  return offset;
}
