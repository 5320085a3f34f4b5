#version 450 core
// Looks at some pixels of a G-buffer, for mistakes that a picture would show and nothing would name.
#define LKAO_DOUBLE 0
#include "gpu/frame/check_block.h"
#include "gpu/frame/g_buffer.glsl"
#include "gpu/frame/position_error.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 0) buffer Results { LKAO_CHECK_RESULTS } results;

// Within two pixels of the pixel's centre, and what the format may have moved it.
bool is_seen_at(vec2 pixel, vec3 in_view, float texel_size) {
  if (is_perspective() && in_view.z >= 0.0) return false;
  vec4 clip = view.clip_from_view * vec4(in_view, 1.0);
  vec2 place = (clip.xy / clip.w * 0.5 + 0.5) * vec2(view.width, view.height);
  float pixel_size = pixel_width(in_view);
  return distance(place, pixel + 0.5) <= 2.0 + texel_size / pixel_size;
}

void main() {
  ivec2 pixel = (2 * ivec2(gl_GlobalInvocationID.xy) + 1) * ivec2(view.width, view.height) / (2 * LKAO_CHECKED_SIDE);
  vec3 position;
  if (!find_position(pixel, position) || !is_position_in_range(position)) return;
  vec3 normal = vec3(read_geometric_normal(pixel));
  if (normal == vec3(0)) return;
  atomicAdd(results.receiver_count, 1u);
  vec3 in_world = transpose(mat3(view.view_from_world)) * (position - view.view_from_world[3].xyz);
  normal = normalize(transpose(mat3(view.view_from_world)) * normal);
  float largest = max(abs(in_world.x), max(abs(in_world.y), abs(in_world.z)));
  atomicMax(results.largest_error_bits, floatBitsToUint(error_along(normal, in_world, largest)));
  if (view.place != LKAO_PLACE_POSITION) return;

  vec3 texel = texelFetch(place, texel_of(pixel), 0).xyz, errors = texel_error(texel);
  float size = length(errors);
  atomicMax(results.largest_texel_bits, floatBitsToUint(max(errors.x, max(errors.y, errors.z))));
  vec3 other = view.has_view_space_positions != 0 ? (view.view_from_world * vec4(texel, 1.0)).xyz : texel;
  vec2 at = vec2(pixel);
  if (is_seen_at(at, position, size)) atomicAdd(results.hit_count, 1u);
  if (is_seen_at(at, other, size)) atomicAdd(results.other_space_hit_count, 1u);
  if (is_seen_at(vec2(at.x, float(view.height) - 1.0 - at.y), position, size)) {
    atomicAdd(results.flipped_hit_count, 1u);
  }
}
