// The G-buffer, for any pass: where the receiver of a pixel is, and its normals. With LKAO_DOUBLE in world space, as
// the CPU has it; else in view space, where floats keep the digits of what is near the eye.
#include "gpu/frame/limits.h"
#include "gpu/frame/units.h"
#include "gpu/frame/real.glsl"
#include "gpu/frame/view.glsl"

layout(binding = LKAO_UNIT_PLACE) uniform sampler2D place;
layout(binding = LKAO_UNIT_NORMALS) uniform sampler2D normals;
layout(binding = LKAO_UNIT_GEOMETRIC_NORMALS) uniform sampler2D geometric_normals;

#if LKAO_DOUBLE
#define LKAO_FROM_CLIP view.world_from_clip
real along_view(dvec3 position) { return dot(dvec3(view.view_depth.xyz), position) + double(view.view_depth.w); }
vec3 from_place(vec3 position) {
  if (view.has_view_space_positions == 0) return position;
  return vec3((view.world_from_view * dvec4(dvec3(position), 1.0lf)).xyz);
}
#else
#define LKAO_FROM_CLIP view.view_from_clip
real along_view(vec3 position) { return -position.z; }
vec3 from_place(vec3 position) {
  if (view.has_view_space_positions != 0) return position;
  return (view.view_from_world * vec4(position, 1.0)).xyz;
}
#endif

// Where the G-buffer has the pixel.
ivec2 texel_of(ivec2 pixel) { return ivec2(view.first_x, view.first_y) + view.step * pixel; }

// Of each pixel of the ray through its centre: a point of the ray, at a depth in clip space.
real3 unproject(ivec2 pixel, real depth) {
  real2 place_on_screen = (real2(pixel) + real(0.5)) * real(2) / real2(view.width, view.height) - real(1);
  real4 h = LKAO_FROM_CLIP * real4(place_on_screen, depth, real(1));
  return h.xyz / h.w;
}

// False where the pixel shows nothing. The position may still not be finite.
bool find_position(ivec2 pixel, out vec3 position) {
  vec4 texel = texelFetch(place, texel_of(pixel), 0);
  if (view.place == LKAO_PLACE_POSITION) {
    position = from_place(texel.xyz);
    return true;
  }
  bool zero_to_one = view.is_zero_to_one != 0, is_reversed = view.is_reversed != 0;
  if (view.place == LKAO_PLACE_DEPTH) {
    real depth = real(texel.x);
    position = vec3(unproject(pixel, zero_to_one ? depth : real(2) * depth - real(1)));
    return is_reversed ? texel.x > 0.0 : texel.x < 1.0;
  }
  // Two points of the pixel's ray that are finite whatever the far plane.
  real middle = zero_to_one ? real(0.5) : real(0);
  real near = is_reversed ? real(1) : real(2) * middle - real(1);
  real3 from = unproject(pixel, near), to = unproject(pixel, middle);
  real from_depth = along_view(from), to_depth = along_view(to);
  position = vec3(from + (to - from) * ((real(texel.x) - from_depth) / (to_depth - from_depth)));
  return !is_perspective() || texel.x > 0.0;
}

bool is_position_in_range(vec3 position) { return all(lessThanEqual(abs(position), vec3(LKAO_LARGEST_COORDINATE))); }

// Cigolle et al. 2014, listing 2; not of unit length.
vec3 from_octahedron(vec2 place) {
  vec3 n = vec3(place, 1.0 - abs(place.x) - abs(place.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
  return n;
}

// As the texture has it; zero where it is no direction.
vec3 decode_normal(vec4 texel, int is_unorm) {
  // Written so that a NaN fails.
  if (!(all(lessThanEqual(abs(texel.xyz), vec3(3.4028234e38))))) return vec3(0);
  vec3 n = is_unorm != 0 ? 2.0 * texel.xyz - 1.0 : texel.xyz;
  if (view.normal_encoding == LKAO_NORMALS_OCTAHEDRAL) return from_octahedron(n.xy);
  if (view.normal_encoding == LKAO_NORMALS_XY) return vec3(n.xy, sqrt(max(1.0 - dot(n.xy, n.xy), 0.0)));
  return n;
}

#if LKAO_DOUBLE
real3 turn_normal(vec3 normal) {
  dvec3 n = dvec3(normal);
  // As it is, with the sign of its zeros: tangents depend on it.
  if (view.has_view_space_normals == 0) return n;
  return n.x * dvec3(view.world_from_normals[0].xyz) + n.y * dvec3(view.world_from_normals[1].xyz) +
         n.z * dvec3(view.world_from_normals[2].xyz);
}
#else
real3 turn_normal(vec3 normal) {
  return view.has_view_space_normals != 0 ? normal : mat3(view.view_from_world) * normal;
}
#endif

// Of any length; zero where the pixel has none.
real3 read_normal(ivec2 pixel) {
  return turn_normal(decode_normal(texelFetch(normals, texel_of(pixel), 0), view.has_unorm_normals));
}

// The shading normal where there is none of its own.
real3 read_geometric_normal(ivec2 pixel) {
  if (view.has_geometric_normals != 0) {
    vec3 own = decode_normal(texelFetch(geometric_normals, texel_of(pixel), 0), view.has_unorm_geometric_normals);
    if (own != vec3(0)) return turn_normal(own);
  }
  return read_normal(pixel);
}
