#version 450 core
// One direction of the cross-bilateral filter (include/lkao/gl/bilateral_filter.h).
#define LKAO_DOUBLE 0
#include "gpu/frame/g_buffer.glsl"
#include "gpu/screen/filter_block.h"
#include "gpu/screen/units.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = LKAO_UNIT_UNFILTERED) uniform sampler2D unfiltered;
layout(binding = 0) writeonly uniform image2D filtered;

struct Surface {
  vec3 position, normal;  // the normal of unit length
};

// False where there is none.
bool find_surface(ivec2 pixel, out Surface surface) {
  if (!find_position(pixel, surface.position) || !is_position_in_range(surface.position)) return false;
  vec3 normal = read_normal(pixel);
  float largest = max(abs(normal.x), max(abs(normal.y), abs(normal.z)));
  if (largest == 0.0) return false;
  // Normals may be of any length: first of one whose square is a float.
  surface.normal = normalize(normal / largest);
  return true;
}

float weight_of(int steps, Surface from, Surface to, float pixel_width) {
  float off_plane = dot(from.normal, to.position - from.position) / (pass.depth_tolerance * pixel_width);
  float alike = pass.normal_sharpness > 0.0 ? pow(max(dot(from.normal, to.normal), 0.0), pass.normal_sharpness) : 1.0;
  return exp(-pass.gauss * float(steps * steps) - off_plane * off_plane) * alike;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (is_outside(pixel)) return;
  Surface middle, other;
  if (!find_surface(pixel, middle)) {
    imageStore(filtered, pixel, vec4(pass.background, 0, 0, 1));
    return;
  }
  float pixel_width = view.pixel_size * (is_perspective() ? -middle.position.z : 1.0);
  float sum = texelFetch(unfiltered, pixel, 0).x, weight_sum = 1.0;
  for (int i = -pass.radius; i <= pass.radius; ++i) {
    ivec2 place = pixel + i * ivec2(pass.step_x, pass.step_y);
    if (i == 0 || any(lessThan(place, ivec2(0))) || is_outside(place) || !find_surface(place, other)) continue;
    float weight = weight_of(i, middle, other, pixel_width);
    sum += weight * texelFetch(unfiltered, place, 0).x;
    weight_sum += weight;
  }
  imageStore(filtered, pixel, vec4(sum / weight_sum, 0, 0, 1));
}
