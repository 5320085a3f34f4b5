// What is seen: the camera and the G-buffer.
#ifndef LKAO_GPU_FRAME_VIEW_BLOCK_H
#define LKAO_GPU_FRAME_VIEW_BLOCK_H

#include "gpu/gl/block.h"

// What tells a pixel's position.
#define LKAO_PLACE_DEPTH 0
#define LKAO_PLACE_LINEAR_DEPTH 1
#define LKAO_PLACE_POSITION 2

// NormalEncoding.
#define LKAO_NORMALS_XYZ 0
#define LKAO_NORMALS_OCTAHEDRAL 1
#define LKAO_NORMALS_XY 2

LKAO_BLOCK_BEGIN(ViewBlock, LKAO_BLOCK_VIEW)
dmat4 world_from_clip;
dmat4 world_from_view;
mat4 clip_from_view;
mat4 view_from_clip;
mat4 view_from_world;
mat4 world_from_normals;  // turns the G-buffer's normals; 3 x 3 of it
vec4 view_depth;          // (x, y, z) . position + w = distance along the view
vec4 eye;                 // perspective: the eye; orthographic: the direction of view
// What position_error.glsl knows, and the other numbers of its kind below.
vec4 clip_depth_size, clip_w_size;  // |rows 2 and 3| of the matrix from world to clip space
int width, height;                  // of the picture that a pass makes
int first_x, first_y;               // the texel of its pixel (0, 0), in the G-buffer
int step;                           // texels from one pixel to the next
int place;                          // LKAO_PLACE_*
int is_perspective;
int is_zero_to_one;  // of depth in clip space
int is_reversed;     // depth falls with the distance
int has_view_space_positions;
int normal_encoding;  // LKAO_NORMALS_*
int has_unorm_normals;
int has_view_space_normals;
int has_geometric_normals;
int has_unorm_geometric_normals;
float
    pixel_size;  // world units that a pixel is wide (at distance 1 from a perspective camera), the larger of both axes
float pixel_step;                 // how far, in the same units, rasterisers move corners
float depth_offset, depth_slope;  // clip-space depth = offset + slope x the distance (perspective: / the distance)
float longest_ray;                // at distance 1 along the view, of all pixels
float place_step, place_ulp;  // from one value of the place texture to the next: always; as a share of its power of 2
float normal_error;           // of the normals' directions by their format, in radians
LKAO_BLOCK_END(view)

#endif
