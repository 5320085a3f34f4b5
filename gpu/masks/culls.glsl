// Cheap tests for fragments that get no occlusion, each with a margin above rounding: they change how long a frame
// takes, never a mask.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 4.2.
//
// Differs from the paper: the first test there compares the fragment's own depth, "greater than depth of receiver point
// plus ambient occlusion radius". The far side of a large triangle's prism may be any distance behind a receiver that
// is inside; what cannot be farther than the radius is the nearest point of the triangle, which is what is compared
// here.
#include "gpu/masks/mask_pass_block.h"
#include "gpu/mesh/shapes.glsl"

const float kMargin = 1e-4;

// 1 to 4: those that need no more than the receiver's position.
bool is_culled_by_place(vec3 origin, float along_view) {
  float radius = shape.range.y, far = shape.nearest_depth - along_view;
  if (pass.culls_far_depth != 0 &&
      far > radius + kMargin * (radius + abs(along_view) + abs(shape.nearest_depth))) {
    return true;
  }
  vec3 to_center = shape.sphere.xyz - origin;
  float reach = (shape.sphere.w + radius) * (1.0 + kMargin);
  if (pass.culls_by_sphere != 0 && dot(to_center, to_center) > reach * reach) return true;
  vec3 to_corner = shape.a - origin;
  float distance = dot(to_corner, shape.normal), rounding = kMargin * length(to_corner);
  if (pass.culls_by_facing != 0 && !is_two_sided() && distance > rounding) return true;
  return pass.culls_by_plane != 0 && abs(distance) > radius + rounding;
}

// 5: all corners are below the horizon.
bool is_culled_by_horizon(vec3 origin, vec3 up) {
  vec3 a = shape.a - origin, b = shape.b - origin, c = shape.c - origin;
  float size = max(length(a), max(length(b), length(c)));
  return pass.culls_by_horizon != 0 && max(dot(up, a), max(dot(up, b), dot(up, c))) < -kMargin * size;
}

float square_distance_to_edge(vec3 from, vec3 along) {
  vec3 nearest = from + clamp(-dot(from, along) / dot(along, along), 0.0, 1.0) * along;
  return dot(nearest, nearest);
}

// The influence region itself: points within r_max of the triangle, not all of which is within r_min. The shapes only
// bound it; masks of nearest cells depend on where it ends, and this makes it end in one place for all of them.
bool is_in_reach(vec3 origin) {
  vec3 a = shape.a - origin, b = shape.b - origin, c = shape.c - origin;
  vec3 ab = shape.b - shape.a, bc = shape.c - shape.b, ca = shape.a - shape.c;
  vec3 n = shape.normal;
  float near = shape.range.x * (1.0 - kMargin), far = shape.range.y * (1.0 + kMargin);
  if (max(dot(a, a), max(dot(b, b), dot(c, c))) < near * near) return false;
  bool is_over = dot(cross(ab, n), a) >= 0.0 && dot(cross(bc, n), b) >= 0.0 && dot(cross(ca, n), c) >= 0.0;
  float square = is_over ? dot(a, n) * dot(a, n)
                         : min(square_distance_to_edge(a, ab),
                               min(square_distance_to_edge(b, bc), square_distance_to_edge(c, ca)));
  return square <= far * far;
}
