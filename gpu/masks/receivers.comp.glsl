#version 450 core
// From the G-buffer to receivers: where the rays of each pixel start, and where the pattern's axes go. As the CPU query
// does it (query::make_rays), in the same precision.
#define LKAO_DOUBLE 1
#include "gpu/frame/g_buffer.glsl"
#include "gpu/masks/jittered_frame.glsl"
#include "gpu/masks/units.h"
#include "gpu/mesh/extent.glsl"
#include "gpu/mesh/surface_offset.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0, rgba32f) writeonly uniform image2DArray receivers;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (is_outside(pixel)) return;
  vec3 position;
  bool is_valid = find_position(pixel, position) && is_position_in_range(position);
  dvec3 normal = read_normal(pixel), geometric = read_geometric_normal(pixel);
  if (!is_valid || normal == dvec3(0.0lf)) {
    for (int layer = 0; layer < LKAO_RECEIVER_LAYER_COUNT; ++layer) {
      imageStore(receivers, ivec3(pixel, layer), vec4(0, 0, 0, LKAO_NO_RECEIVER));
    }
    return;
  }
  vec3 up = vec3(unit(geometric));
  precise float offset = surface_offset(position, up);
  precise vec3 origin = position + up * offset;
  if (shapes.is_unbounded != 0) include_point(kOrigins, origin);
  uint index = uint(pixel.y) * uint(view.width) + uint(pixel.x);
  // Minus zero counts as pointing down, as it does for std::copysign.
  dvec3 axis = unit(normal);
  bool points_down = (unpackDouble2x32(axis.z).y & 0x80000000u) != 0u;
  mat3 frame = jittered_frame(axis, points_down, index);
  imageStore(receivers, ivec3(pixel, LKAO_RECEIVER_ORIGIN), vec4(origin, float(along_view(dvec3(origin)))));
  for (int i = 0; i < 3; ++i) imageStore(receivers, ivec3(pixel, LKAO_RECEIVER_FRAME + i), vec4(frame[i], up[i]));
}
