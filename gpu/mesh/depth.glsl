// The pass's own depth: 1 at the camera, falling with distance, so that the far side of a volume passes where its depth
// is less than the receiver's. Its range does not depend on the camera's near and far planes.
#include "gpu/mesh/shapes.glsl"

float depth_at(float along_view) {
  return is_perspective() ? shapes.depth_scale / along_view : (shapes.depth_far - along_view) * shapes.depth_scale;
}
