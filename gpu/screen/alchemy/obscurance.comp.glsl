#version 450 core
// Obscurance of each pixel by those around it.
//
// Based on: M. McGuire, B. Osman, M. Bukowski, P. Hennessy, "The Alchemy Screen-Space Ambient Obscurance Algorithm",
// HPG 2011, Sec. 2.3.
// Differs from the paper:
// - Eq. 10 has lost the cut-off at the radius, H(r - |v|) of Eq. 9; without it all of a disc darkens, whatever its
//   depth.
// - Samples of a pixel come from a sequence that is begun at random and leaves no large gaps, not from random numbers
//   alone: less noise from as many.
// - How many bands of samples a receiver takes is decided by how large the disc is on the screen: the paper leaves it
//   open.
// - With shading normals, what lies below the surface itself obscures nothing, though it may be above their horizon.
#define LKAO_DOUBLE 0
#include "gpu/frame/target.glsl"
#include "gpu/screen/alchemy/disc.glsl"
#include "gpu/screen/hash.glsl"
#include "gpu/screen/receivers.glsl"
#include "gpu/screen/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

struct Receiver {
  ivec2 pixel;
  vec3 position, normal, geometric_normal;
  float bias;        // in the unit of the positions
  mat2 disc;         // from the disc of radius 1 to pixels
  float disc_radius;  // in pixels
};

float distance_of_bias(vec3 position) { return is_perspective() ? -position.z : pass.parallel_distance; }

// Steps of the AO radius to the right and upwards move a point so many pixels, as they leave its distance alone.
mat2 disc_of(vec3 position) {
  float w = is_perspective() ? -position.z : 1.0;
  vec2 half_size = 0.5 * min(pass.radius / w, 1e18) * vec2(view.width, view.height);
  return mat2(half_size * view.clip_from_view[0].xy, half_size * view.clip_from_view[1].xy);
}

// ObscuranceFalloff, for x^2 below 1.
float falloff(float squared_distance, float height) {
  float inside = 1.0 - squared_distance;
  switch (pass.falloff) {
    case LKAO_FALLOFF_SMOOTH:
      return 5.0 / 3.0 * inside * inside * inside * height / (squared_distance + pass.epsilon);
    case LKAO_FALLOFF_MEDIUM:
      return 20.0 / 3.0 * inside * height;
    case LKAO_FALLOFF_LOW:
      return 10.0 / 3.0 * height;
  }
  return height / (squared_distance + pass.epsilon);
}

// One term of the sum in Eq. 10.
float obscurance_by(Receiver receiver, ivec2 pixel) {
  vec4 position = receiver_position(pixel);
  if (position.w == 0.0) return 0.0;
  vec3 v = position.xyz - receiver.position;
  vec3 in_radii = v / pass.radius;
  float squared_distance = dot(in_radii, in_radii);
  float height = dot(v, receiver.normal) - receiver.bias;
  float height_over_surface = dot(v, receiver.geometric_normal) - receiver.bias;
  if (squared_distance >= 1.0 || height <= 0.0 || height_over_surface <= 0.0) return 0.0;
  return falloff(squared_distance, height / pass.radius);
}

int sample_count(Receiver receiver) {
  int band_count = pass.max_band_count;
  for (float least = pass.full_radius; band_count > 1 && receiver.disc_radius < least; least *= 0.5) --band_count;
  return band_count * pass.samples_per_band;
}

// A of Eq. 10.
float visibility(Receiver receiver) {
  int count = sample_count(receiver);
  uvec2 random = hash(uvec3(receiver.pixel, pass.seed)).xy;
  vec2 middle = vec2(receiver.pixel) + 0.5, size = vec2(view.width, view.height);
  float sum = 0.0;
  for (int i = 0; i < count; ++i) {
    vec2 at = middle + receiver.disc * sample_place(i, count, random);
    if (any(lessThan(at, vec2(0))) || any(greaterThanEqual(at, size))) continue;
    sum += obscurance_by(receiver, ivec2(at));
  }
  return pow(max(1.0 - 2.0 * pass.intensity / float(count) * sum, 0.0), pass.contrast);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (is_outside(pixel)) return;
  vec4 position = receiver_position(pixel);
  if (position.w == 0.0) {
    write_background(pixel);
    return;
  }
  vec3 at = position.xyz;
  // Behind the eye nothing is seen.
  if (is_perspective() && at.z >= 0.0) {
    write_occlusion(pixel, 0.0);
    return;
  }
  Receiver receiver =
      Receiver(pixel, at, receiver_normal(pixel), unit_normal(read_geometric_normal(pixel)),
               pass.bias * distance_of_bias(at), disc_of(at), pass.radius / pixel_width(at));
  write_occlusion(pixel, 1.0 - visibility(receiver));
}
