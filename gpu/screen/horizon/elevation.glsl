// How high something stands above a receiver's tangent plane.
#include "gpu/screen/horizon/slice.glsl"

// In the plane of the direction to the eye, which may not quite be the slice's: pixels lie beside its line by up to
// half a pixel. In its own plane nothing of a flat surface rises, and its height is taken for that in the slice.
float elevation_of(Receiver receiver, vec3 to) {
  float squared = dot(to, to), forward = dot(to, receiver.to_eye), height = dot(to, receiver.up);
  float across = sqrt(max(squared - forward * forward, 0.0));
  // Of `to` along `up`'s projection, and along the tangent plane, both times the same.
  return atan(across * height, dot(receiver.up, receiver.to_eye) * squared - forward * height);
}

// The same without what may be an error: sin^2, of which the occlusion of a slice is made, loses at most the bias'.
float biased_elevation(Receiver receiver, vec3 to) {
  float elevation = elevation_of(receiver, to);
  float bias = pass.angle_bias + 2.0 * receiver.error * inversesqrt(dot(to, to));
  return elevation > bias ? sqrt(elevation * elevation - bias * bias) : 0.0;
}

// How much an occluder at this distance, less than the radius, counts.
float falloff(float away) {
  if (pass.falloff_begin >= 1.0) return 1.0;
  return clamp((1.0 - away / pass.radius) / (1.0 - pass.falloff_begin), 0.0, 1.0);
}
