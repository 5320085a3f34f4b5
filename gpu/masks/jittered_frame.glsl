// The frame of a receiver: query::jittered_frame of the CPU, in double precision as there, so that nearly all frames
// are the same to the last bit of float.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 3.
#include "gpu/masks/mask_pass_block.h"
#include "gpu/masks/random.glsl"

const double kTwoPi = 6.283185307179586476925286766559lf;

// Cosine and sine of so many turns, in [0, 1], to the rounding of double: GLSL has only those of float.
dvec2 cos_sin(double turns) {
  int quarter = int(floor(turns * 4.0lf + 0.5lf));
  double x = (turns - 0.25lf * double(quarter)) * kTwoPi, x2 = x * x;  // |x| <= pi/4: series
  double c = 1.0lf, s = 1.0lf;
  for (int k = 18; k >= 2; k -= 2) {
    c = 1.0lf - c * x2 / double(k * (k - 1));
    s = 1.0lf - s * x2 / double(k * (k + 1));
  }
  s *= x;
  switch (quarter & 3) {
    case 0: return dvec2(c, s);
    case 1: return dvec2(-s, c);
    case 2: return dvec2(-c, -s);
    default: return dvec2(s, -c);
  }
}

dvec3 unit(dvec3 v) {
  precise double square = v.x * v.x + v.y * v.y + v.z * v.z;
  return v * (1.0lf / sqrt(square));
}

// T. Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
void make_tangents(dvec3 n, bool points_down, out dvec3 tangent, out dvec3 bitangent) {
  double turned = points_down ? -1.0lf : 1.0lf;
  double a = -1.0lf / (turned + n.z);
  double b = n.x * n.y * a;
  tangent = dvec3(1.0lf + turned * n.x * n.x * a, turned * b, -turned * n.x);
  bitangent = dvec3(b, turned + n.y * n.y * a, -n.y);
}

// `normal` is of unit length; `index` is the pixel's number.
mat3 jittered_frame(dvec3 normal, bool points_down, uint index) {
  uvec2 random = mix_bits(uvec2(pass.seed_low, pass.seed_high) ^ uvec2(index, 0u));
  double turn = next_double(random) * double(pass.jitter_rotation);
  dvec3 axis = normal, tangent, bitangent;
  make_tangents(axis, points_down, tangent, bitangent);
  if (pass.jitter_tilt > 0.0) {
    double tilt = double(pass.jitter_tilt) * sqrt(next_double(random));
    dvec2 towards = cos_sin(next_double(random)), tilted = cos_sin(tilt / kTwoPi);
    dvec3 sideways = towards.x * tangent + towards.y * bitangent;
    axis = unit(tilted.x * normal + tilted.y * sideways);
    make_tangents(axis, axis.z < 0.0lf, tangent, bitangent);
  }
  dvec2 turned = cos_sin(turn);
  return mat3(vec3(turned.x * tangent + turned.y * bitangent), vec3(turned.x * bitangent - turned.y * tangent),
              vec3(axis));
}
