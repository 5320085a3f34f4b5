#version 450 core
// The far half: a rectangle on the screen around all that a sphere reaches.
//
// Based on: P. Shanmugam, O. Arikan, "Hardware Accelerated Ambient Occlusion Techniques on GPUs", I3D 2007, Sec. 5.2.
// Differs from the paper: the rectangle is that of the ball of radius d_far, whose outline in perspective is no circle
// around the projected centre.
#include "gpu/frame/limits.h"
#include "gpu/frame/view.glsl"
#include "gpu/screen/splat/splat_block.h"
#include "gpu/screen/splat/units.h"

layout(binding = LKAO_UNIT_SPLAT_SPHERES) uniform samplerBuffer spheres;
flat out vec4 sphere;  // in view space

// Beyond every picture, on a screen at distance 1.
const float kFar = 1e6;

float reach;  // d_far

// By the bits of floats, which have their order and put NaN last: drivers turn comparisons round, and NaN with them.
bool is_usable(vec4 s) {
  uvec4 sizes = floatBitsToUint(s) & 0x7fffffffu;
  return s.w > 0.0 && all(lessThanEqual(sizes, uvec4(floatBitsToUint(float(LKAO_LARGEST_COORDINATE)))));
}

// Where rays from the eye touch a circle on both sides, as coordinates on a screen at distance 1. `centre`: across the
// view and along it; not wholly behind the eye.
vec2 tangents(vec2 centre, float radius) {
  float squared = dot(centre, centre) - radius * radius;
  if (squared <= 0.0) return vec2(-kFar, kFar);  // the eye is inside
  float along = sqrt(squared);
  // The centre's direction turned by asin(radius / distance), to either side.
  vec2 low = vec2(centre.x * along - centre.y * radius, centre.y * along + centre.x * radius);
  vec2 high = vec2(centre.x * along + centre.y * radius, centre.y * along - centre.x * radius);
  return vec2(low.y > 0.0 ? max(low.x / low.y, -kFar) : -kFar, high.y > 0.0 ? min(high.x / high.y, kFar) : kFar);
}

vec2 corner_in_perspective(ivec2 corner) {
  vec2 x = tangents(vec2(sphere.x, -sphere.z), reach), y = tangents(vec2(sphere.y, -sphere.z), reach);
  // Of a point at distance 1.
  return (view.clip_from_view * vec4(x[corner.x], y[corner.y], -1, 1)).xy;
}

vec2 corner_in_parallel(ivec2 corner) {
  mat4 rows = transpose(view.clip_from_view);
  vec2 middle = (view.clip_from_view * vec4(sphere.xyz, 1)).xy;
  return middle + reach * (2.0 * vec2(corner) - 1.0) * vec2(length(rows[0].xyz), length(rows[1].xyz));
}

void main() {
  const ivec2 kCorners[6] = ivec2[](ivec2(0, 0), ivec2(1, 0), ivec2(1, 1), ivec2(0, 0), ivec2(1, 1), ivec2(0, 1));
  vec4 in_world = texelFetch(spheres, gl_VertexID / 6);
  gl_Position = vec4(0, 0, 0, 1);  // all six: nothing is drawn
  sphere = vec4((view.view_from_world * vec4(in_world.xyz, 1)).xyz, in_world.w);
  // A little more than what counts, for rounding.
  reach = 1.0001 * min(pass.reach * sphere.w, pass.far_end + sphere.w);
  if (!is_usable(in_world) || (is_perspective() && reach <= sphere.z)) return;
  ivec2 corner = kCorners[gl_VertexID % 6];
  gl_Position.xy = is_perspective() ? corner_in_perspective(corner) : corner_in_parallel(corner);
}
