// How far the position that a G-buffer gives a pixel may be off the surface that was drawn there: by the format of the
// texture, by the projection, and by the arithmetic of vertex shaders and rasterisers. Bounds, but for the
// numbers of roundings.
//
// A depth buffer's error is one of the depth in clip space, z = offset + slope / t at the distance t along the view: it
// moves the position along the pixel's ray by t^2 / slope times as much.
#include "gpu/frame/view.glsl"

const float kUlp = 1.1920929e-7;
// Roundings that stand for those of vertex shaders and rasterisers: of depths, relative to the coordinates and depths
// that go into them; and of interpolated positions, relative to the largest coordinate. gpu/README.md has what was
// measured.
const float kRounding = 1.0 * kUlp, kPositionRounding = 24.0 * kUlp;
// Shading normals stand in for those of the triangles where there are no others: they may lean from them so far.
const float kLean = 0.125;

// What a texel may be off: OpenGL lets a value be stored as either of its neighbours, so it is a whole step.
float texel_error(float value) {
  float power_of_two = uintBitsToFloat(floatBitsToUint(value) & 0x7f800000u);
  return view.place_step + view.place_ulp * power_of_two;
}
vec3 texel_error(vec3 value) { return vec3(texel_error(value.x), texel_error(value.y), texel_error(value.z)); }

// Of the depth in clip space. `size` are the largest coordinates in play.
float clip_depth_error(float along_view, vec4 size) {
  float w = is_perspective() ? along_view : 1.0;
  float depth = view.depth_offset + view.depth_slope * (is_perspective() ? 1.0 / along_view : along_view);
  float vertex = dot(view.clip_depth_size, size) + abs(depth) * dot(view.clip_w_size, size);
  // Not by powers of two: the error must grow with the distance, for largest_error().
  float stored = view.is_zero_to_one != 0 ? view.place_step + view.place_ulp * depth
                                          : 2.0 * view.place_step + view.place_ulp * (depth + 1.0);
  return stored + kRounding * (abs(depth) + vertex / w);
}

// Of the distance along the view, as depths of any kind give it.
float distance_error(float along_view, vec4 size) {
  if (view.place == LKAO_PLACE_LINEAR_DEPTH) {
    return texel_error(along_view) + kRounding * dot(abs(view.view_depth), size);
  }
  float error = clip_depth_error(along_view, size) / abs(view.depth_slope);
  if (!is_perspective()) return error;
  float share = along_view * error;  // of 1 / t
  return share < 0.5 ? along_view * share / (1.0 - share) : along_view;
}

// What goes into positions in view space, too.
float with_eye(float largest) {
  vec3 move = abs(view.view_from_world[3].xyz);
  return view.has_view_space_positions != 0 ? max(largest, max(move.x, max(move.y, move.z))) : largest;
}

// Along the unit vector `normal`, in world space. `largest` is the largest coordinate in play.
float error_along(vec3 normal, vec3 position, float largest) {
  if (view.place == LKAO_PLACE_POSITION) {
    // Components are rounded in the space that they are in.
    bool is_in_view = view.has_view_space_positions != 0;
    vec3 axis = is_in_view ? mat3(view.view_from_world) * normal : normal;
    vec3 stored = is_in_view ? (view.view_from_world * vec4(position, 1.0)).xyz : position;
    return dot(abs(axis), texel_error(stored)) + kPositionRounding * with_eye(largest);
  }
  float along_view = distance_along_view(position);
  vec3 ray = is_perspective() ? (position - view.eye.xyz) / along_view : view.eye.xyz;
  float forward = dot(normal, view.view_depth.xyz), lean = view.normal_error + kLean;
  // Rasterisers put corners on a grid, so a depth is that of a point beside the pixel's centre.
  float beside = view.pixel_step * (is_perspective() ? along_view : 1.0);
  return distance_error(along_view, vec4(vec3(largest), 1)) * (abs(dot(normal, ray)) + lean * length(ray)) +
         beside * (sqrt(max(1.0 - forward * forward, 0.0)) + lean);
}

// At least error_along() of all positions up to this distance along the view.
float largest_error(float along_view, float largest) {
  if (view.place == LKAO_PLACE_POSITION) {
    bool is_in_view = view.has_view_space_positions != 0;
    float stored = is_in_view ? abs(along_view) * view.longest_ray + with_eye(largest) : largest;
    return 1.7320508 * texel_error(stored) + kPositionRounding * with_eye(largest);
  }
  float lean = 1.0 + view.normal_error + kLean, beside = view.pixel_step * (is_perspective() ? along_view : 1.0);
  return lean * (distance_error(along_view, vec4(vec3(largest), 1)) * view.longest_ray + beside);
}
