// A slice: the plane through a receiver, the eye, and a direction across the view. Angles in it are measured from the
// direction to the eye, towards that direction; pixels along a line on the screen show what lies in it.
//
// Based on: J. Jimenez, X.-C. Wu, A. Pesce, A. Jarabo, "Practical Realtime Strategies for Accurate Indirect Occlusion",
// SIGGRAPH 2016 Courses, Technical Memo ATVI-TR-16-01.
// Differs from the paper:
// - Slices are planes through the eye at their angles around the direction to it, in perspective and off the middle of
//   the screen too, where the paper takes directions on the screen for them.
// - They may be drawn by how much of the cosine-weighted hemisphere they hold, so that each counts the same: no open
//   surface is noisy, and slices that hold little cost nothing. Else they are weighed, and the sum is divided by that
//   of the weights.
// - The walk ends where the AO radius does on the screen, found exactly, and not where it does at the receiver's depth.
#include "gpu/frame/view.glsl"
#include "gpu/screen/horizon/horizon_block.h"

const float kPi = 3.14159265;

struct Receiver {
  ivec2 pixel;
  vec3 position;
  vec3 normal;       // the axis of the hemisphere
  vec3 up;           // the surface's own normal: nothing is cast below it, and it looks to the eye
  vec3 to_eye;
  vec3 side, other;  // across the view: the plane of `normal` and `to_eye` holds the first
  float error;       // how far positions may be off the surface
};

struct Slice {
  vec3 along;                 // at right angles to the direction to the eye
  float turn, normal_length;  // of the normal's projection onto the slice
  float up_turn;              // the angle of the projection of `up`
  float lower, upper;         // where the directions begin and end that are cast
  float density;              // how likely the slice is drawn, 1 on average
  vec2 step;                  // on the screen, from pixel to pixel: one of both is 1 or -1
  float step_width;           // how far that is in the world, at the receiver's depth
  float ends[2];              // steps up to the end of the AO radius, forwards and backwards
};

// The integral of the cosine to the normal over the directions of a slice from that to the eye to `angle`, for a
// projection of length 1 at the angle `turn`: of cos(x - turn) |sin(x)| dx. That of the paper, negative backwards.
float measure(float angle, float turn) {
  return sign(angle) * 0.25 * (cos(turn) - cos(2.0 * angle - turn) + 2.0 * angle * sin(turn));
}
float cast_measure(Slice slice) { return measure(slice.upper, slice.turn) - measure(slice.lower, slice.turn); }

// Cosine-weighted directions around a normal, by their slice. With c and s, cosine and sine of the angle between the
// normal and the direction to the eye, a slice at the angle x from the plane of both holds, of pi in all,
//
//   measure(turn + pi / 2) - measure(turn - pi / 2) = c + s cos(x) turn,   tan(turn) = s cos(x) / c,
//
// whose integral from 0 is atan2(c sin(x), cos(x)) + s sin(x) turn.
float slice_density(float azimuth, float c, float s) {
  float across = s * cos(azimuth);
  return c + across * atan(across, c);
}

// The slice below which there is this share of them, from -pi / 2 to pi / 2. The start is exact for c of 0 and 1; two
// rounds of Newton's method come to within 1e-6 of the share.
float slice_azimuth(float share, float c, float s) {
  float wanted = kPi * (share - 0.5);
  float azimuth = mix(asin(clamp(2.0 * share - 1.0, -1.0, 1.0)), wanted, c);
  for (int i = 0; i < 2; ++i) {
    float off = atan(c * sin(azimuth), cos(azimuth)) + s * sin(azimuth) * atan(s * cos(azimuth), c) - wanted;
    azimuth = clamp(azimuth - off / slice_density(azimuth, c, s), -0.5 * kPi, 0.5 * kPi);
  }
  return azimuth;
}

// Steps t, forwards and backwards, after which rays of view along `ray + t * move` no longer come as near to the
// receiver as the radius.
void find_ends(Receiver receiver, vec3 ray, vec3 move, out float ends[2]) {
  const float kNever = 1e9;
  if (!is_perspective()) {
    ends = float[](pass.radius / length(move), pass.radius / length(move));
    return;
  }
  // The ray is as near as the radius where |(ray + t move) x position|^2 = radius^2 |ray + t move|^2. Its cross product
  // with `ray` is 0, so, over radius^2, a t^2 + b t + c = 0 with
  vec3 off = cross(move, receiver.position) / pass.radius;
  float a = dot(move, move) - dot(off, off), b = 2.0 * dot(ray, move), c = dot(ray, ray);
  float discriminant = b * b - 4.0 * a * c;
  ends = float[](kNever, kNever);
  if (discriminant < 0.0) return;  // the eye is in the ball
  // One root lies on either side of 0, or, where the ball reaches behind the eye, none on that of b.
  float q = -0.5 * (b + (b > 0.0 ? 1.0 : -1.0) * sqrt(discriminant));
  float there = a < 0.0 ? abs(q / a) : kNever, back = abs(c / q);
  ends = b > 0.0 ? float[](there, back) : float[](back, there);
}

// Where the line of a slice runs on the screen.
void find_line(Receiver receiver, inout Slice slice) {
  float away = is_perspective() ? -receiver.position.z : 1.0;
  vec3 ray = is_perspective() ? receiver.position / away : vec3(0);
  // How the ray moves, in a plane at distance 1, where its end moves along the slice.
  vec3 move = is_perspective() ? (slice.along + ray * slice.along.z) / away : slice.along;
  vec2 on_screen = 0.5 * vec2(view.width, view.height) * (mat2(view.clip_from_view) * move.xy);
  float scale = 1.0 / max(abs(on_screen.x), abs(on_screen.y));
  slice.step = scale * on_screen;
  slice.step_width = scale;  // `along` is of length 1
  find_ends(receiver, ray, scale * move, slice.ends);
  float farthest = pass.screen_radius / length(slice.step);
  for (int side = 0; side < 2; ++side) slice.ends[side] = min(slice.ends[side], farthest);
}

// Needs `up` to look to the eye. `share`: of all slices, from 0 to 1.
Slice make_slice(Receiver receiver, float share) {
  // Normals that hardly look to the eye, or not at all, are drawn as if they did a little: none is then unlikely.
  float c = max(dot(receiver.normal, receiver.to_eye), 0.05), s = sqrt(max(1.0 - c * c, 0.0));
  float azimuth = pass.has_even_slices != 0 ? kPi * (share - 0.5) : slice_azimuth(share, c, s);
  Slice slice;
  slice.density = pass.has_even_slices != 0 ? 1.0 : slice_density(azimuth, c, s);
  slice.along = cos(azimuth) * receiver.side + sin(azimuth) * receiver.other;
  vec2 normal = vec2(dot(receiver.normal, receiver.to_eye), dot(receiver.normal, slice.along));
  slice.normal_length = length(normal);
  slice.turn = slice.normal_length > 0.0 ? atan(normal.y, normal.x) : 0.0;
  slice.up_turn = atan(dot(receiver.up, slice.along), dot(receiver.up, receiver.to_eye));
  slice.lower = max(slice.turn, slice.up_turn) - 0.5 * kPi;
  slice.upper = min(slice.turn, slice.up_turn) + 0.5 * kPi;
  find_line(receiver, slice);
  return slice;
}

// How much a slice counts among the others.
float weight_of(Slice slice) {
  if (slice.lower >= slice.upper) return 0.0;
  return (pass.has_equal_angles != 0 ? 1.0 : slice.normal_length * cast_measure(slice)) / slice.density;
}
