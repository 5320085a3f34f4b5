// The ball on the surface, and how much of its lines of view is free.
//
// Based on: J. Boksansky, A. Pospisil, J. Bittner, "VAO++: Practical Volumetric Ambient Occlusion for Games",
// EGSR 2017, Sec. 3 and 4.4.
// Differs from the paper:
// - A sample is the line of view through the middle of the pixel that it lies in, not the line through the sample: so
//   the depth is known on the very line, and a plane stays open at any angle, to rounding.
// - F of Eq. 2 is the sum of these lines' pipes, instead of those that the samples would have in parallel projection.
//   Numerator and denominator are still off together, which is what the paper wants of it.
// - Samples beyond the picture count in neither sum.
// - The ball does not reach behind the plane of the eye: it is smaller there.
#include "gpu/gl/fragment_counters.glsl"
#include "gpu/screen/hash.glsl"
#include "gpu/screen/receivers.glsl"
#include "gpu/screen/vao/units.h"
#include "gpu/screen/vao/vao_block.h"

struct Ball {
  vec3 centre;
  float radius;
  // On the picture, in pixels: the centre, and the ball's radius to the right and upwards in view space.
  vec2 place, right, up;
};

// What Eq. 1 adds up.
struct Pipes {
  float free, whole;
};

Ball ball_at(vec3 position, vec3 normal) {
  Ball ball;
  ball.radius = pass.ball_radius;
  // So that the centre is at least a radius before the eye.
  if (is_perspective()) ball.radius = clamp(-position.z / (1.0 + max(normal.z, 0.0)), 0.0, ball.radius);
  ball.centre = position + ball.radius * normal;
  vec4 clip = view.clip_from_view * vec4(ball.centre, 1.0);
  vec2 scale = vec2(view.width, view.height) / clip.w;
  ball.place = 0.5 * (clip.xy * scale + vec2(view.width, view.height));
  // The disc is parallel to the screen, so clip.w is the same all over it.
  ball.right = 0.5 * ball.radius * scale * view.clip_from_view[0].xy;
  ball.up = 0.5 * ball.radius * scale * view.clip_from_view[1].xy;
  return ball;
}

// How the line of view through a pixel goes on, by 1 along the view.
vec3 line_direction(ivec2 pixel) {
  if (!is_perspective()) return pass.parallel.xyz;
  return pass.line_first.xyz + float(pixel.x) * pass.line_right.xyz + float(pixel.y) * pass.line_up.xyz;
}

// Of the line of view, as far from the eye as the ball's centre.
vec3 line_point(ivec2 pixel, float along) {
  vec3 first = pass.line_first.xyz + float(pixel.x) * pass.line_right.xyz + float(pixel.y) * pass.line_up.xyz;
  return is_perspective() ? along * first : first + along * pass.parallel.xyz;
}

// Eq. 4: what is blocked at the distance `behind` what the pixel shows.
float blocked_behind(float behind) {
  return pass.thickness < 0.0 ? 1.0 : pass.thickness / max(pass.thickness, behind / pass.radius);
}

// One term of both sums of Eq. 1. `seen`: what the pixel shows, w: 1, or 0 for nothing.
void add_pipe(Ball ball, ivec2 pixel, vec4 seen, inout Pipes pipes) {
  bool is_there = seen.w > 0.0;
  vec3 point = is_there ? seen.xyz : line_point(pixel, -ball.centre.z);
  // Through the very point, whatever the G-buffer's precision.
  vec3 direction = is_there && is_perspective() ? point / -point.z : line_direction(pixel);
  float squared_length = dot(direction, direction);
  vec3 to_centre = ball.centre - point;
  // Along the view, from the point to the middle of the pipe, and half of the pipe.
  float middle = dot(to_centre, direction) / squared_length;
  vec3 off = to_centre - middle * direction;
  float squared_half = (ball.radius * ball.radius - dot(off, off)) / squared_length;
  if (!(squared_half > 0.0)) return;
  float half_pipe = sqrt(squared_half), whole = 2.0 * half_pipe;
  float free = is_there ? clamp(half_pipe - middle, 0.0, whole) : whole;  // cases A and B
  float behind = middle - half_pipe;
  if (is_there && behind > 0.0) free = whole * (1.0 - blocked_behind(behind));  // case C
  pipes.free += free;
  pipes.whole += whole;
}

// On GPUs a number divided by itself may be a little more than 1.
float occlusion_of(Pipes pipes) { return pipes.whole > 0.0 ? max(1.0 - pipes.free / pipes.whole, 0.0) : 0.0; }

// The places of a pixel's samples in the unit disc.
struct Samples {
  int count;
  bool is_sequence;
  mat2 turn;    // of a set
  uvec2 start;  // of a sequence
};

// EGSR 2017, Sec. 4.5: the pixels of 3 x 3 turn a set by a ninth each.
Samples set_samples(ivec2 pixel, int count) {
  float angle = float(pixel.x % 3 + 3 * (pixel.y % 3)) * (6.28318531 / 9.0);
  return Samples(count, false, mat2(cos(angle), sin(angle), -sin(angle), cos(angle)), uvec2(0));
}

Samples sequence_samples(ivec2 pixel) {
  return Samples(pass.sequence_size, true, mat2(1.0), hash(uvec3(pixel, pass.seed)).xy);
}

vec2 sample_place(Samples samples, int i) {
  if (samples.is_sequence) {
    // They cover the disc evenly: the powers of 1 / 1.3247..., the real root of x^3 = x + 1, moved by the start.
    vec2 share = vec2((samples.start + uint(i) * uvec2(3242174889u, 2447445414u)) >> 8u) * exp2(-24.0);
    float angle = 6.28318531 * share.y;
    return sqrt(share.x) * vec2(cos(angle), sin(angle));
  }
  int index = samples.count - 2 + i;
  vec4 two = pass.places[index >> 1];
  return samples.turn * ((index & 1) != 0 ? two.zw : two.xy);
}

ivec2 sample_pixel(Ball ball, Samples samples, int i) {
  vec2 place = sample_place(samples, i);
  return ivec2(floor(ball.place + place.x * ball.right + place.y * ball.up));
}

Pipes pipes_of(Ball ball, Samples samples) {
  Pipes pipes = Pipes(0.0, 0.0);
  for (int i = 0; i < samples.count; ++i) {
    ivec2 pixel = sample_pixel(ball, samples, i);
    if (!is_on_picture(pixel)) continue;
    COUNT_2;
    add_pipe(ball, pixel, receiver_position(pixel), pipes);
  }
  return pipes;
}
