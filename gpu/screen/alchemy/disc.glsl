// Places of samples in a disc of radius 1.
#include "gpu/screen/alchemy/alchemy_block.h"

const float kPi = 3.14159265;

struct DiscPlace {
  vec2 at;
  float weight;
};

DiscPlace place_at(float away, float turn, float weight) {
  return DiscPlace(away * vec2(cos(2.0 * kPi * turn), sin(2.0 * kPi * turn)), weight);
}

// From 0 to below 1.
vec2 share_of(uvec2 bits) { return vec2(bits >> 8u) * exp2(-24.0); }

// Based on: M. McGuire, M. Mara, D. Luebke, "Scalable Ambient Obscurance", HPG 2012, Eqs. 6 and 7.
DiscPlace place_on_spiral(int i, int count, float first_turn) {
  float alpha = (float(i) + 0.5) / float(count);
  float away = pass.pattern == LKAO_PATTERN_EVEN_SPIRAL ? sqrt(alpha) : alpha;
  return place_at(away, fract(alpha * pass.spiral_turns) + first_turn, 1.0);
}

// Of a sequence that leaves no large gaps (the powers of 1 / 1.3247..., the real root of x^3 = x + 1), begun anywhere.
DiscPlace place_of_sequence(int i, uvec2 first) {
  const uvec2 kStep = uvec2(3242174889u, 2447445414u);
  vec2 share = share_of(first + uint(i) * kStep);
  // A density of 1 / (2 pi away) in place of the even 1 / pi.
  if (pass.pattern == LKAO_PATTERN_WEIGHTED) return place_at(share.x, share.y, 2.0 * share.x);
  return place_at(sqrt(share.x), share.y, 1.0);
}

// `random`: of the pixel.
DiscPlace disc_place(int i, int count, uvec2 random) {
  bool is_spiral = pass.pattern == LKAO_PATTERN_SPIRAL || pass.pattern == LKAO_PATTERN_EVEN_SPIRAL;
  return is_spiral ? place_on_spiral(i, count, share_of(random).x) : place_of_sequence(i, random);
}
