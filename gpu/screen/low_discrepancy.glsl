// Numbers that differ from those of the pixels around, and of the seeds before, as much as they can.

// Of a pixel in a tile of 64 x 64, along a Hilbert curve.
uint hilbert_index(uvec2 place) {
  uint index = 0u;
  for (uint half_side = 32u; half_side > 0u; half_side >>= 1u) {
    uint right = (place.x & half_side) != 0u ? 1u : 0u, top = (place.y & half_side) != 0u ? 1u : 0u;
    index = index << 2u | ((3u * right) ^ top);
    // Turn the quadrant so that the curve enters and leaves it where its neighbours do.
    place &= half_side - 1u;
    if (top == 0u) {
      if (right == 1u) place = half_side - 1u - place;
      place = place.yx;
    }
  }
  return index;
}

// Two numbers from 0 up to 1. Along the curve, multiples of the powers of 1 / 1.3247..., the real root of x^3 = x + 1;
// from seed to seed, of the golden ratio and the square root of 2.
//
// M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018; along a Hilbert curve: F. Strugar, S.
// McCalla, "XeGTAO", Intel 2021.
vec2 low_discrepancy(ivec2 pixel, uint seed) {
  uvec2 place = hilbert_index(uvec2(pixel) & 63u) * uvec2(3242174889u, 2447445414u);
  place += seed * uvec2(2654435769u, 1779033704u);
  return vec2(place >> 8u) * exp2(-24.0);
}
