// The pass's own depth: 1 at the camera, falling with distance, so that the far side of a volume passes where its depth
// is less than the receiver's. Its range does not depend on the camera's near and far planes.
#include "gpu/mesh/shapes.glsl"

float depth_at(float along_view) {
  return is_perspective() ? shapes.depth_scale / along_view : (shapes.depth_far - along_view) * shapes.depth_scale;
}

// Of a receiver, for the inverted depth test (Laine & Karras 2010, Sec. 4, step 3c): a little nearer than it is, for
// interpolated depths are off by some 1e-4 (shapes limit their range to 1000).
float receiver_depth(float along_view) {
  float nearer = along_view - 1e-3 * (abs(along_view) + ao_radius());
  float depth = is_perspective() && nearer <= 0.0 ? 1.0 : depth_at(nearer);
  return clamp(depth, 0.0, 1.0);
}
