// The rays of a receiver, as query::turn_pattern computes them: the same bits.
#include "gpu/masks/units.h"
#include "gpu/mesh/shapes.glsl"

layout(binding = LKAO_UNIT_RECEIVERS) uniform sampler2DArray receivers;
layout(binding = LKAO_UNIT_PATTERN) uniform samplerBuffer pattern;

struct Frame {
  vec3 x, y, z;  // where the pattern's axes go
  vec3 up;       // geometric normal
};

Frame fetch_frame(ivec2 pixel) {
  vec4 x = texelFetch(receivers, ivec3(pixel, LKAO_RECEIVER_FRAME), 0);
  vec4 y = texelFetch(receivers, ivec3(pixel, LKAO_RECEIVER_FRAME + 1), 0);
  vec4 z = texelFetch(receivers, ivec3(pixel, LKAO_RECEIVER_FRAME + 2), 0);
  return Frame(x.xyz, y.xyz, z.xyz, vec3(x.w, y.w, z.w));
}

vec3 ray_direction(Frame frame, vec3 local) {
  precise vec3 direction = (frame.x * local.x + frame.y * local.y) + frame.z * local.z;
  return direction;
}

float ray_length(int i) {
  precise float length = texelFetch(pattern, i).w * ao_radius();
  return length;
}

vec3 ray(Frame frame, int i) {
  precise vec3 end = ray_direction(frame, texelFetch(pattern, i).xyz) * ray_length(i);
  return end;
}

// Rays below the geometric horizon are not cast.
bool is_cast(Frame frame, int i) {
  vec3 direction = ray_direction(frame, texelFetch(pattern, i).xyz);
  precise float height = (direction.x * frame.up.x + direction.y * frame.up.y) + direction.z * frame.up.z;
  return height > 0.0;
}
