// What one call of draw() or resolve() is about: PassUniforms in C++, in the same order.
#include "constants.h"

layout(std140, binding = 0) uniform Pass {
  dmat4 world_from_clip;
  mat4 clip_from_world;     // its z is the pass's own, see depth.glsl
  vec4 view_depth;          // (x, y, z) . position + w = distance along the view
  vec4 eye;                 // perspective: the eye; orthographic: the direction of view
  vec4 normal_to_world[3];  // columns
  vec4 depth_map;           // see depth.glsl
  vec4 lengths;             // AO radius (see extent.glsl), threshold alpha, surface offset x 2^-24, size of a pixel (at distance 1)
  vec4 jitter;              // rotation in turns, largest tilt in radians; what resolve() writes without a receiver
  ivec4 extent;             // width, height, unused, LKAO_PLACE_*
  uvec4 flags;              // LKAO_FLAG_*, ray count, seed as mix_bits(seed): low and high
  uvec4 cells;              // of the table: resolution or cells along the maps' sides: edges, slices; slice count
  uvec4 cell_offsets;       // of the table: cells of the map of edges, cells of a slice; first cell for rays of one length
} pass;

bool has_flag(uint flag) { return (pass.flags.x & flag) != 0u; }
float ao_radius() { return pass.lengths.x; }
float distance_along_view(vec3 position) { return dot(pass.view_depth.xyz, position) + pass.view_depth.w; }
