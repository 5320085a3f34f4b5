// How far the base of a volume reaches beyond the corners of its triangle.
//
// Based on: M. McGuire, "Ambient Occlusion Volumes", HPG 2010, Eqs. 9 to 13 and Sec. 5.1.

// e_i of Eq. 12, found by the geometry that it solves: along the bisector to where both planes at `delta` outside of
// the edges meet, that is delta / sin(half the angle at the corner). "Clamp all ||e_i|| to at most 2 delta": `clamps`,
// which takes something from every corner sharper than 60 degrees.
vec3 extension(vec3 previous, vec3 corner, vec3 next, vec3 normal, float delta, bool clamps) {
  vec3 in_edge = normalize(corner - previous), out_edge = normalize(next - corner);
  vec3 in_normal = cross(in_edge, normal), out_normal = cross(out_edge, normal);
  // Both sums point outwards along the bisector; one is long where the other is short.
  vec3 outwards = normalize((in_normal + out_normal) + (in_edge - out_edge));
  float half_sine = max(dot(in_normal, outwards), 1e-4);
  return outwards * (clamps ? min(delta / half_sine, 2.0 * delta) : delta / half_sine);
}

// The base's corners, in the plane of the triangle.
void extend(vec3 a, vec3 b, vec3 c, vec3 normal, float delta, bool clamps, out vec3 base[3]) {
  base[0] = a + extension(c, a, b, normal, delta, clamps);
  base[1] = b + extension(a, b, c, normal, delta, clamps);
  base[2] = c + extension(b, c, a, normal, delta, clamps);
}
