#version 450 core
// From the G-buffer to receivers: where the rays of each pixel start, and where the pattern's axes go. As the CPU query does
// it (query::make_rays), in the same precision.
#include "pass.glsl"
#include "frame.glsl"
#include "extent.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = LKAO_UNIT_PLACE) uniform sampler2D place;
layout(binding = LKAO_UNIT_NORMALS) uniform sampler2D normals;
layout(binding = LKAO_UNIT_GEOMETRIC_NORMALS) uniform sampler2D geometric_normals;
layout(binding = LKAO_UNIT_LARGEST) uniform samplerBuffer largest_coordinate;
layout(binding = 0, rgba32f) writeonly uniform image2DArray receivers;

// Of each pixel of the ray through its centre: a point of the ray, in world space, at a depth in clip space.
dvec3 unproject(ivec2 pixel, double depth) {
  dvec2 place_on_screen = (dvec2(pixel) + 0.5lf) * 2.0lf / dvec2(pass.extent.xy) - 1.0lf;
  dvec4 h = pass.world_from_clip * dvec4(place_on_screen, depth, 1.0lf);
  return h.xyz / h.w;
}

double along_view(dvec3 position) {
  return dot(dvec3(pass.view_depth.xyz), position) + double(pass.view_depth.w);
}

// False where the pixel shows nothing.
bool find_position(ivec2 pixel, out vec3 position) {
  vec4 texel = texelFetch(place, pixel, 0);
  position = texel.xyz;
  if (pass.extent.w == LKAO_PLACE_POSITION) return true;
  bool zero_to_one = has_flag(LKAO_FLAG_ZERO_TO_ONE);
  if (pass.extent.w == LKAO_PLACE_DEPTH) {
    double depth = double(texel.x);
    position = vec3(unproject(pixel, zero_to_one ? depth : 2.0lf * depth - 1.0lf));
    return has_flag(LKAO_FLAG_REVERSED) ? texel.x > 0.0 : texel.x < 1.0;
  }
  // Two points of the pixel's ray that are finite whatever the far plane.
  double middle = zero_to_one ? 0.5lf : 0.0lf;
  double near = has_flag(LKAO_FLAG_REVERSED) ? 1.0lf : 2.0lf * middle - 1.0lf;
  dvec3 from = unproject(pixel, near), to = unproject(pixel, middle);
  double from_depth = along_view(from), to_depth = along_view(to);
  position = vec3(from + (to - from) * ((double(texel.x) - from_depth) / (to_depth - from_depth)));
  return !has_flag(LKAO_FLAG_PERSPECTIVE) || texel.x > 0.0;
}

// The normal in world space; zero where it is no direction.
dvec3 read_normal(sampler2D image, ivec2 pixel, uint unorm_flag) {
  vec3 n = texelFetch(image, pixel, 0).xyz;
  // Written so that a NaN fails.
  if (!(all(lessThanEqual(abs(n), vec3(3.4028234e38))))) return dvec3(0.0lf);
  if (has_flag(unorm_flag)) n = 2.0 * n - 1.0;
  dvec3 d = dvec3(n);
  // As it is, with the sign of its zeros: tangents hang on it.
  if (!has_flag(LKAO_FLAG_VIEW_SPACE_NORMALS)) return d;
  return d.x * dvec3(pass.normal_to_world[0].xyz) + d.y * dvec3(pass.normal_to_world[1].xyz) +
         d.z * dvec3(pass.normal_to_world[2].xyz);
}

float largest_component(vec3 v) { return max(abs(v.x), max(abs(v.y), abs(v.z))); }

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, pass.extent.xy))) return;
  vec3 position;
  bool is_valid = find_position(pixel, position) && all(lessThanEqual(abs(position), vec3(1e18)));
  dvec3 normal = read_normal(normals, pixel, LKAO_FLAG_UNORM_NORMALS), geometric = normal;
  if (has_flag(LKAO_FLAG_GEOMETRIC_NORMALS)) {
    dvec3 own = read_normal(geometric_normals, pixel, LKAO_FLAG_UNORM_GEOMETRIC_NORMALS);
    if (own != dvec3(0.0lf)) geometric = own;
  }
  if (!is_valid || normal == dvec3(0.0lf)) {
    for (int layer = 0; layer < LKAO_RECEIVER_LAYER_COUNT; ++layer) {
      imageStore(receivers, ivec3(pixel, layer), vec4(0, 0, 0, LKAO_NO_RECEIVER));
    }
    return;
  }
  vec3 up = vec3(unit(geometric));
  float largest = texelFetch(largest_coordinate, 0).x;
  precise float offset = pass.lengths.z * max(largest_component(position), largest);
  precise vec3 origin = position + up * offset;
  if (has_flag(LKAO_FLAG_UNBOUNDED)) include_point(kOrigins, origin);
  uint index = uint(pixel.y) * uint(pass.extent.x) + uint(pixel.x);
  // Minus zero counts as pointing down, as it does for std::copysign.
  dvec3 axis = unit(normal);
  bool points_down = (unpackDouble2x32(axis.z).y & 0x80000000u) != 0u;
  mat3 frame = jittered_frame(axis, points_down, index);
  imageStore(receivers, ivec3(pixel, LKAO_RECEIVER_ORIGIN), vec4(origin, float(along_view(dvec3(origin)))));
  for (int i = 0; i < 3; ++i) imageStore(receivers, ivec3(pixel, LKAO_RECEIVER_FRAME + i), vec4(frame[i], up[i]));
}
