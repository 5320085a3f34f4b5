// How occlusion falls off with the distance from a polygon.
//
// Based on: M. McGuire, "Ambient Occlusion Volumes", HPG 2010, Eqs. 5 to 8.

// The factor of one plane of Eq. 8: 1 inside of it, 0 from `delta` outside of it. `inward` is its unit normal, `point`
// lies on it, and the receiver is at the origin.
float falloff_beyond(vec3 point, vec3 inward, float delta) {
  return clamp(1.0 - dot(point, inward) / delta, 0.0, 1.0);
}

// Eq. 7; the corners run counter-clockwise about the unit vector `normal`, which is -m_k.
vec3 inward_normal(vec3 from, vec3 to, vec3 normal) { return cross(normal, normalize(to - from)); }

// g of Eq. 8 without the opacity, on the side to which `normal` points. Behind the polygon it is 1.
float falloff(vec3 a, vec3 b, vec3 c, vec3 normal, float delta) {
  return falloff_beyond(a, -normal, delta) * falloff_beyond(a, inward_normal(a, b, normal), delta) *
         falloff_beyond(b, inward_normal(b, c, normal), delta) * falloff_beyond(c, inward_normal(c, a, normal), delta);
}
