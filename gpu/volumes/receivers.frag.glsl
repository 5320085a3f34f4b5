#version 450 core
// From the G-buffer to receivers: where each pixel's is, its normals, and its depth for the inverted depth test.
#define LKAO_DOUBLE 1
#include "gpu/frame/g_buffer.glsl"
#include "gpu/mesh/depth.glsl"
#include "gpu/mesh/surface_offset.glsl"

layout(location = 0) out vec4 origin;  // in the world; w: 1, or 0 where there is no receiver
layout(location = 1) out vec4 axis;    // the shading normal; w: the share of its hemisphere above the surface
layout(location = 2) out vec4 up;      // the geometric normal

dvec3 unit(dvec3 v) { return v * (1.0lf / sqrt(dot(v, v))); }

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 position;
  bool is_valid = find_position(pixel, position) && is_position_in_range(position);
  dvec3 normal = read_normal(pixel), geometric = read_geometric_normal(pixel);
  origin = axis = up = vec4(0);
  gl_FragDepth = 0.0;  // the far end: nothing is less
  if (!is_valid || normal == dvec3(0.0lf)) return;
  axis.xyz = vec3(unit(normal));
  up.xyz = vec3(unit(geometric));
  // Directions below the geometric horizon count for nothing, as for the query, which casts no rays there. Both
  // hemispheres have so much in common, weighted by the cosine to the shading normal.
  axis.w = 0.5 + 0.5 * dot(axis.xyz, up.xyz);
  if (axis.w < 1e-4) return;
  origin = vec4(position + up.xyz * surface_offset(position, up.xyz), 1);
  gl_FragDepth = receiver_depth(distance_along_view(origin.xyz));
}
