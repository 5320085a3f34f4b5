// How much of the light from an even sky a polygon blocks: exact, in closed form.
//
// Based on: M. McGuire, "Ambient Occlusion Volumes", HPG 2010, Eq. 4, after D. Baum, H. Rushmeier, J. Winget,
// "Improving Radiosity Solutions Through the Use of Analytically Determined Form-Factors", SIGGRAPH 1989.
//
// Differs from the paper: angles are atan(|p x q|, p . q) instead of the arc cosine, which has no digits where a
// polygon is small or far away; and the polygon may be cut by the horizon of the geometric normal too.

// A triangle that two planes have cut: of 5 corners at most, or 6 where rounding takes the second plane in and out.
struct Polygon {
  vec3 corners[6];
  int count;
};

Polygon triangle_of(vec3 a, vec3 b, vec3 c) {
  Polygon polygon;
  polygon.corners[0] = a;
  polygon.corners[1] = b;
  polygon.corners[2] = c;
  polygon.count = 3;
  return polygon;
}

// What lies above the plane through the origin that is square to `up`: Step 4.iv.b. None of it where all lies in the
// plane.
Polygon above(Polygon polygon, vec3 up) {
  Polygon kept;
  kept.count = 0;
  vec3 last = polygon.corners[polygon.count - 1];
  float last_height = dot(up, last);
  for (int i = 0; i < polygon.count; ++i) {
    vec3 corner = polygon.corners[i];
    float height = dot(up, corner);
    bool is_above = height > 0.0;
    if (is_above != (last_height > 0.0)) {
      kept.corners[kept.count++] = mix(last, corner, last_height / (last_height - height));
    }
    if (is_above) kept.corners[kept.count++] = corner;
    last = corner;
    last_height = height;
  }
  return kept;
}

// Eq. 4 for a receiver at the origin with the unit normal `normal`, and a polygon above its horizon that runs clockwise
// as seen from it (as one that faces it does): the share of the cosine-weighted hemisphere, 0 to 1. Negative where it
// runs the other way round.
float form_factor(Polygon polygon, vec3 normal) {
  float sum = 0.0;
  if (polygon.count == 0) return sum;
  vec3 from = polygon.corners[polygon.count - 1];
  for (int i = 0; i < polygon.count; ++i) {
    vec3 to = polygon.corners[i];
    // from x to, with less that cancels.
    vec3 across = cross(from, to - from);
    float size = length(across);
    // An edge that points at the receiver is seen under no angle.
    if (size > 0.0) sum -= atan(size, dot(from, to)) * dot(normal, across) / size;
    from = to;
  }
  return sum * 0.15915494;  // / 2 pi
}
