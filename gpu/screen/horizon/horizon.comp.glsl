#version 450 core
// Occlusion of one pixel: what the depth buffer blocks of some slices.
//
// Based on: J. Jimenez, X.-C. Wu, A. Pesce, A. Jarabo, "Practical Realtime Strategies for Accurate Indirect Occlusion",
// SIGGRAPH 2016 Courses, Technical Memo ATVI-TR-16-01; O. Therrien, Y. Levesque, G. Gilet, "Screen Space Indirect
// Lighting with Visibility Bitmask", 2023, arXiv:2301.11376.
// Differs from the first paper:
// - Horizons sink by a length, the thickness, and not by a share each step, so that more steps come to a limit.
// - With shading normals, what lies below the surface itself blocks nothing and is not cast, as this library's rays.
// LKAO_BITMASK: masks of sectors; 0: horizons.
#define LKAO_DOUBLE 0
#include "gpu/frame/position_error.glsl"
#include "gpu/frame/target.glsl"
#include "gpu/screen/hash.glsl"
#include "gpu/screen/horizon/sectors.glsl"
#include "gpu/screen/low_discrepancy.glsl"
#include "gpu/screen/receivers.glsl"
#include "gpu/screen/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

// The unit of a step's place, from one slice to the next.
const float kGoldenRatio = 0.61803399;

float error_of(vec3 position, vec3 up) {
  mat3 world_from_view = transpose(mat3(view.view_from_world));
  vec3 in_world = world_from_view * (position - view.view_from_world[3].xyz);
  float largest = max(abs(in_world.x), max(abs(in_world.y), abs(in_world.z)));
  return error_along(world_from_view * up, in_world, largest);
}

Receiver find_receiver(ivec2 pixel, vec3 position) {
  Receiver receiver;
  receiver.pixel = pixel;
  receiver.position = position;
  receiver.normal = receiver_normal(pixel);
  receiver.to_eye = is_perspective() ? -normalize(position) : vec3(0, 0, 1);
  receiver.up = unit_normal(read_geometric_normal(pixel));
  if (receiver.up == vec3(0)) receiver.up = receiver.normal;
  // What is seen looks to the eye; shading normals that stand in for the surface's may not.
  float facing = dot(receiver.up, receiver.to_eye);
  if (facing < 1e-4) receiver.up = normalize(receiver.up + (1e-4 - facing) * receiver.to_eye);
  vec3 side = receiver.normal - dot(receiver.normal, receiver.to_eye) * receiver.to_eye;
  vec3 axis = abs(receiver.to_eye.x) < 0.5 ? vec3(1, 0, 0) : vec3(0, 1, 0);
  if (dot(side, side) < 1e-8) side = axis - dot(axis, receiver.to_eye) * receiver.to_eye;
  receiver.side = normalize(side);
  receiver.other = cross(receiver.to_eye, receiver.side);
  receiver.error = error_of(position, receiver.up);
  return receiver;
}

// Where step i goes, in pixels of the line; farther than that of step i - 1 unless they are dense.
float place_of(int i, float move, float end) {
  float share = (float(i) + move) / float(pass.step_count);
  return max(float(i + 1), floor(end * pow(share, pass.step_exponent) + 0.5));
}

bool step_to(Receiver receiver, Slice slice, float side, float place, out vec4 position) {
  ivec2 pixel = receiver.pixel + ivec2(floor(side * place * slice.step + 0.5));
  if (!is_on_picture(pixel)) return false;
  position = receiver_position(pixel);
  return true;
}

#if LKAO_BITMASK
float slice_occlusion(Receiver receiver, Slice slice, float move, uvec3 random) {
  Sectors sectors = Sectors(float(random.x >> 8u) * exp2(-24.0), float(random.y >> 8u) * exp2(-24.0), random.z >> 27u);
  uint blocked = 0u;
  for (int side = 0; side < 2; ++side) {
    float end = slice.ends[side], forward = side == 0 ? 1.0 : -1.0;
    for (int i = 0; i < pass.step_count; ++i) {
      float place = place_of(i, move, end);
      vec4 front;
      if (place > end || !step_to(receiver, slice, forward, place, front)) break;
      if (front.w > 0.0) blocked |= sectors_blocked(receiver, slice, sectors, forward, front.xyz);
    }
  }
  return float(bitCount(blocked)) / 32.0;
}
#else
// The elevation of the horizon on one side.
float find_horizon(Receiver receiver, Slice slice, int side, float move) {
  float horizon = 0.0, last = 0.0, end = slice.ends[side];
  for (int i = 0; i < pass.step_count; ++i) {
    float place = place_of(i, move, end);
    vec4 position;
    if (place > end || !step_to(receiver, slice, side == 0 ? 1.0 : -1.0, place, position)) break;
    vec3 to = position.xyz - receiver.position;
    float away = length(to), elevation = 0.0;
    bool is_near = position.w > 0.0 && away < pass.radius && away > 0.0;
    if (is_near) elevation = biased_elevation(receiver, to) * falloff(away);
    float kept = exp(-(place - last) * slice.step_width / pass.thickness);
    horizon = elevation >= horizon ? elevation : mix(elevation, horizon, kept);
    last = place;
  }
  return horizon;
}

float slice_occlusion(Receiver receiver, Slice slice, float move, uvec3 random) {
  float upper = 0.5 * kPi + slice.up_turn - find_horizon(receiver, slice, 0, move);
  float lower = 0.5 * kPi - slice.up_turn - find_horizon(receiver, slice, 1, move);
  upper = clamp(max(upper, 0.0), slice.lower, slice.upper);
  lower = clamp(-max(lower, 0.0), slice.lower, slice.upper);
  float visible = measure(upper, slice.turn) - measure(lower, slice.turn);
  return clamp(1.0 - visible / cast_measure(slice), 0.0, 1.0);
}
#endif

float occlusion_of(Receiver receiver) {
  vec2 first = low_discrepancy(receiver.pixel, pass.seed);
  float sum = 0.0, weight_sum = 0.0;
  for (int i = 0; i < pass.slice_count; ++i) {
    Slice slice = make_slice(receiver, (float(i) + first.x) / float(pass.slice_count));
    float weight = weight_of(slice);
    if (weight <= 0.0) continue;
    float move = fract(first.y + float(i) * kGoldenRatio);
    uvec3 random = hash(uvec3(receiver.pixel, pass.seed * 512u + uint(i)));
    sum += weight * slice_occlusion(receiver, slice, move, random);
    weight_sum += weight;
  }
  return weight_sum > 0.0 ? min(sum / weight_sum, 1.0) : 0.0;  // on GPUs a quotient may round up
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (is_outside(pixel)) return;
  vec4 position = receiver_position(pixel);
  if (position.w > 0.0) {
    write_occlusion(pixel, occlusion_of(find_receiver(pixel, position.xyz)));
  } else {
    write_background(pixel);
  }
}
