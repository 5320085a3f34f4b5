// Places of samples in a disc of radius 1 (DiscPattern).
#include "gpu/screen/alchemy/alchemy_block.h"

// From 0 to below 1.
vec2 share_of(uvec2 bits) { return vec2(bits >> 8u) * exp2(-24.0); }

vec2 disc_place(float away, float turn) {
  float angle = 2.0 * 3.14159265 * turn;
  return away * vec2(cos(angle), sin(angle));
}

// As often everywhere, by a sequence that leaves no large gaps (the powers of 1 / 1.3247..., the real root of
// x^3 = x + 1), begun anywhere.
vec2 place_of_sequence(int i, uvec2 first) {
  const uvec2 kStep = uvec2(3242174889u, 2447445414u);
  vec2 share = share_of(first + uint(i) * kStep);
  return disc_place(sqrt(share.x), share.y);
}

// Based on: M. McGuire, M. Mara, D. Luebke, "Scalable Ambient Obscurance", HPG 2012, Eqs. 6 and 7.
vec2 place_on_spiral(int i, int count, float first_turn) {
  float alpha = (float(i) + 0.5) / float(count);
  float away = pass.pattern == LKAO_PATTERN_EVEN_SPIRAL ? sqrt(alpha) : alpha;
  return disc_place(away, fract(alpha * pass.spiral_turns) + first_turn);
}

// `random`: of the pixel.
vec2 sample_place(int i, int count, uvec2 random) {
  if (pass.pattern == LKAO_PATTERN_JITTERED) return place_of_sequence(i, random);
  return place_on_spiral(i, count, share_of(random).x);
}
