// A slice as a mask of 32 sectors.
//
// Based on: O. Therrien, Y. Levesque, G. Gilet, "Screen Space Indirect Lighting with Visibility Bitmask", 2023,
// arXiv:2301.11376.
// Differs from the paper:
// - Sectors may hold equal cosine-weighted measures and not equal angles. Bits are counted as before.
// - A sector is blocked where its middle is, and the middles are moved by a random number: on average, what is covered
//   counts as wide as it is. The authors round up: what is thinner than a sector counts as one.
// - The back lies along the ray of the occluder's own pixel, and not along the receiver's: there it is hidden by the
//   front. What of it is beyond the AO radius does not count.
// - Sectors may have lengths of their own, as rays of this library have, for a falloff.
#include "gpu/screen/horizon/elevation.glsl"

struct Sectors {
  float move;        // of the middles, from 0 to 1 sector
  float reach_move;  // the same of lengths
  uint turn;         // which of the sectors are long
};

// The first so many of the sectors, in an order in which each lies far from those before.
const uint kReaching[33] = uint[](
    0x00000000u, 0x00000001u, 0x00010001u, 0x00010101u, 0x01010101u, 0x01010111u, 0x01110111u, 0x01111111u, 0x11111111u,
    0x11111115u, 0x11151115u, 0x11151515u, 0x15151515u, 0x15151555u, 0x15551555u, 0x15555555u, 0x55555555u, 0x55555557u,
    0x55575557u, 0x55575757u, 0x57575757u, 0x57575777u, 0x57775777u, 0x57777777u, 0x77777777u, 0x7777777fu, 0x777f777fu,
    0x777f7f7fu, 0x7f7f7f7fu, 0x7f7f7fffu, 0x7fff7fffu, 0x7fffffffu, 0xffffffffu);

// Those that are at least as long as an occluder is away.
uint sectors_reaching(Sectors sectors, float away) {
  uint first = kReaching[min(uint(32.0 * falloff(away) + sectors.reach_move), 32u)];
  return sectors.turn == 0u ? first : first << sectors.turn | first >> (32u - sectors.turn);
}

// How many sectors begin below an angle.
uint sectors_below(Slice slice, Sectors sectors, float angle) {
  angle = clamp(angle, slice.lower, slice.upper);  // beyond, cosines are negative
  float from_lower = pass.has_equal_angles != 0 ? angle - slice.lower
                                                : measure(angle, slice.turn) - measure(slice.lower, slice.turn);
  float all = pass.has_equal_angles != 0 ? slice.upper - slice.lower : cast_measure(slice);
  return min(uint(32.0 * clamp(from_lower / all, 0.0, 1.0) + sectors.move), 32u);
}

uint first_sectors(uint count) { return count == 32u ? 0xffffffffu : (1u << count) - 1u; }

uint sectors_between(Slice slice, Sectors sectors, float low, float high) {
  return first_sectors(sectors_below(slice, sectors, high)) & ~first_sectors(sectors_below(slice, sectors, low));
}

// As far behind its front as an occluder counts: by its thickness, or up to the AO radius around the receiver.
vec3 back_of(Receiver receiver, vec3 front) {
  vec3 to = front - receiver.position, away = is_perspective() ? normalize(front) : vec3(0, 0, -1);
  float along = dot(to, away);
  float most = sqrt(max(along * along + pass.radius * pass.radius - dot(to, to), 0.0)) - along;
  return to + min(pass.thickness, most) * away;
}

// What an occluder blocks on one side of a slice: 1 forwards, -1 backwards.
uint sectors_blocked(Receiver receiver, Slice slice, Sectors sectors, float side, vec3 front) {
  vec3 to = front - receiver.position;
  float away = length(to);
  if (away >= pass.radius || away == 0.0) return 0u;
  float elevation = biased_elevation(receiver, to);
  if (elevation == 0.0) return 0u;
  float tangent = 0.5 * kPi + side * slice.up_turn;
  float near = max(tangent - elevation, 0.0);
  float far = max(tangent - biased_elevation(receiver, back_of(receiver, front)), near);
  uint covered = side > 0.0 ? sectors_between(slice, sectors, near, far) : sectors_between(slice, sectors, -far, -near);
  return covered & sectors_reaching(sectors, away);
}
