// What the VAO pass alone knows.
#ifndef LKAO_GPU_SCREEN_VAO_VAO_BLOCK_H
#define LKAO_GPU_SCREEN_VAO_VAO_BLOCK_H

#include "gpu/gl/block.h"

// Of the culling.
#define LKAO_VAO_CULL_NOTHING 0
#define LKAO_VAO_CULL_GREEDILY 1
#define LKAO_VAO_CULL_CAREFULLY 2

LKAO_BLOCK_BEGIN(VaoBlock, LKAO_BLOCK_PASS)
vec4 places[31];  // all sample sets: two places each
// The lines of view: through the middle of the picture's corner at pixel (0, 0), and from pixel to pixel. Perspective:
// points at distance 1; orthographic: points at distance 0.
vec4 line_first, line_right, line_up;
vec4 parallel;        // orthographic: how they go on, by 1 along the view
vec4 bleeding_steps;  // as TargetBlock::steps
float ball_radius;
float radius;      // twice that
float thickness;   // below 0: infinite
int largest_size;  // of the sets; 0: a sequence instead
int sequence_size;
uint seed;
float fewest_samples_width;
int culling;  // LKAO_VAO_CULL_*
int tile_columns, tile_rows;
float luminance_begin;  // where occlusion begins to fall
float luminance_scale;  // 1 / how far it falls; 0: it does not
float luminance_sigma;
int uses_value;       // for brightness, not luminance
int bleeding_stride;  // 0: no colours bleed
int bleeding_x, bleeding_y;
LKAO_BLOCK_END(pass)

#endif
