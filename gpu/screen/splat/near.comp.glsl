#version 450 core
// The near half: the spheres of the pixels around a receiver.
//
// Based on: P. Shanmugam, O. Arikan, "Hardware Accelerated Ambient Occlusion Techniques on GPUs", I3D 2007, Sec. 4.2.
// Differs from the paper:
// - A random subset of the pixels is scaled to stand for all of them, so that the number of samples does not change how
//   dark the picture is.
// - Its places come from a sequence that is moved by a hash of the pixel, not from a texture of random numbers, and may
//   lie densest in the middle, where what a pixel blocks is most.
// - With shading normals, what lies below the surface itself blocks nothing, though it may be above their horizon.
#include "gpu/screen/hash.glsl"
#include "gpu/screen/receivers.glsl"
#include "gpu/screen/splat/sphere.glsl"
#include "gpu/screen/splat/units.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = LKAO_UNIT_SPLAT_PIXEL_SPHERES) uniform sampler2DArray pixel_spheres;
layout(binding = 0, r32f) writeonly uniform image2D sum;

// Half of a pixel's diagonal: a disc that is larger by it holds all of each pixel whose centre is in the smaller one.
const float kHalfDiagonal = 0.70710678;
const float kPi = 3.14159265;

struct Receiver {
  ivec2 pixel;
  vec3 position, normal;
  vec3 up;  // out of the surface, of any length
};

// Of all layers at a pixel, one term each of Eq. 4.
float occlusion_by(Receiver receiver, ivec2 pixel) {
  float occlusion = 0.0;
  for (int layer = 0; layer < pass.layer_count; ++layer) {
    vec4 sphere = texelFetch(pixel_spheres, ivec3(pixel, layer), 0);
    vec3 to = sphere.xyz - receiver.position;
    float squared_distance = dot(to, to), height = dot(receiver.normal, to);
    bool is_near = sphere.w > 0.0 && squared_distance < pass.near_radius * pass.near_radius;
    if (!is_near || height <= 0.0 || dot(receiver.up, to) <= 0.0) continue;
    float squared_sine = min(sphere.w * sphere.w / squared_distance, 1.0);
    occlusion += sphere_occlusion(squared_sine, height * inversesqrt(squared_distance));
  }
  return occlusion;
}

bool is_in_disc(ivec2 pixel, ivec2 middle, float radius) {
  vec2 off = vec2(pixel - middle);
  return is_on_picture(pixel) && dot(off, off) <= radius * radius;
}

// Eq. 4 as it stands.
float sum_over_all(Receiver receiver, float radius) {
  float occlusion = 0.0;
  ivec2 reach = ivec2(radius), size = ivec2(view.width, view.height);
  ivec2 first = max(receiver.pixel - reach, ivec2(0)), last = min(receiver.pixel + reach, size - 1);
  for (int y = first.y; y <= last.y; ++y) {
    for (int x = first.x; x <= last.x; ++x) {
      if (is_in_disc(ivec2(x, y), receiver.pixel, radius)) occlusion += occlusion_by(receiver, ivec2(x, y));
    }
  }
  return occlusion;
}

// The integral of 1 / distance over a pixel's square, `off` from the middle of the disc.
float inverse_distance(vec2 off) {
  float squared = dot(off, off);
  // Its series, where that is exact to 1e-5; the closed form would lose its digits there.
  if (squared >= 9.0) return inversesqrt(squared) * (1.0 + 1.0 / (24.0 * squared));
  vec2 low = abs(off) - 0.5, high = low + 1.0;
  float sum = 0.0;
  for (int corner = 0; corner < 4; ++corner) {
    vec2 p = vec2((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y);
    float away = length(p);
    // d2/dxdy of x log(y + r) + y log(x + r) is 1 / r.
    float primitive = p.x * log(p.y + away) + p.y * log(p.x + away);
    sum += corner == 0 || corner == 3 ? primitive : -primitive;
  }
  return sum;
}

// Places in a disc that holds all of the pixels that count. Each is weighed by 1 / its chance to be hit by a sample:
// 1 / area, or the integral over the pixel of 1 / (2 pi wide distance). The sequence (the powers of 1 / 1.3247..., the
// real root of x^3 = x + 1) leaves no large gaps.
float sum_over_subset(Receiver receiver, float radius, int count) {
  const uvec2 kStep = uvec2(3242174889u, 2447445414u);
  bool is_falling = pass.has_falling_density != 0;
  uvec2 place = hash(uvec3(receiver.pixel, pass.seed)).xy;
  float wide = radius + kHalfDiagonal, occlusion = 0.0;
  for (int i = 0; i < count; ++i, place += kStep) {
    vec2 share = vec2(place >> 8u) * exp2(-24.0);
    float away = wide * (is_falling ? share.x : sqrt(share.x)), turn = 2.0 * kPi * share.y;
    ivec2 pixel = receiver.pixel + ivec2(floor(away * vec2(cos(turn), sin(turn)) + 0.5));
    if (pixel == receiver.pixel || !is_in_disc(pixel, receiver.pixel, radius)) continue;
    float weight = is_falling ? 2.0 / inverse_distance(vec2(pixel - receiver.pixel)) : wide;
    occlusion += weight * occlusion_by(receiver, pixel);
  }
  return occlusion * kPi * wide / float(count);
}

// near_radius on the screen, in pixels; no longer than there are pixels.
float disc_radius(Receiver receiver) {
  vec2 farthest = vec2(max(receiver.pixel, ivec2(view.width, view.height) - 1 - receiver.pixel));
  return min(pass.near_radius / pixel_width(receiver.position), length(farthest));
}

float near_occlusion(Receiver receiver) {
  float radius = disc_radius(receiver), area = kPi * (radius + kHalfDiagonal) * (radius + kHalfDiagonal);
  float count = min(ceil(pass.samples_per_pixel * radius), float(pass.max_sample_count));
  if (count >= area) return sum_over_all(receiver, radius);
  return sum_over_subset(receiver, radius, max(int(count), 1));
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (is_outside(pixel)) return;
  vec4 position = receiver_position(pixel);
  vec4 own = texelFetch(pixel_spheres, ivec3(pixel, 0), 0);
  float occlusion = 0.0;
  if (pass.layer_count > 0 && position.w > 0.0 && own.w > 0.0) {
    occlusion = near_occlusion(Receiver(pixel, position.xyz, receiver_normal(pixel), position.xyz - own.xyz));
  }
  imageStore(sum, pixel, vec4(occlusion, 0, 0, 0));
}
