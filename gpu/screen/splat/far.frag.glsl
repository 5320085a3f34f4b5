#version 450 core
// The far half: what one sphere blocks of one receiver; blending adds it up.
//
// Based on: P. Shanmugam, O. Arikan, "Hardware Accelerated Ambient Occlusion Techniques on GPUs", I3D 2007, Sec. 5.2,
// Sec. 6.
// Differs from the paper:
// - Pixels within the billboard but beyond d_far get nothing, so that the picture does not depend on billboards.
// - Only the share of a sphere that is beyond the near half counts, where the paper lets both overlap; so that nothing
//   jumps, it grows from nothing to all while the sphere passes that distance.
// - Where a receiver comes near a sphere, it fades (InsideSphere::faded), where the paper blocks all within.
#include "gpu/screen/receivers.glsl"
#include "gpu/screen/splat/sphere.glsl"
#include "gpu/screen/splat/units.h"

flat in vec4 sphere;
layout(location = 0) out float occlusion;

// How much of the sphere's extent along the line to the receiver lies where the far half counts.
float share_in_range(float distance_to_it) {
  float nearest = max(pass.far_begin, pass.fade_begin * sphere.w);
  float begin = max(distance_to_it - sphere.w, nearest), end = min(distance_to_it + sphere.w, pass.far_end);
  return clamp((end - begin) / (2.0 * sphere.w), 0.0, 1.0);
}

void main() {
  occlusion = 0.0;
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 position = receiver_position(pixel);
  vec3 to = sphere.xyz - position.xyz;
  float squared_distance = dot(to, to), squared_radius = sphere.w * sphere.w;
  if (position.w == 0.0 || squared_distance >= pass.reach * pass.reach * squared_radius) return;
  if (squared_distance <= squared_radius) {
    occlusion = pass.blocks_inside != 0 ? 1.0 : 0.0;
    return;
  }
  float height = dot(receiver_normal(pixel), to);
  if (height <= 0.0) return;
  float distance_to_it = sqrt(squared_distance);
  occlusion = share_in_range(distance_to_it) *
              sphere_occlusion(squared_radius / squared_distance, height / distance_to_it);
}
