// What the horizon pass alone knows.
#ifndef LKAO_GPU_SCREEN_HORIZON_HORIZON_BLOCK_H
#define LKAO_GPU_SCREEN_HORIZON_HORIZON_BLOCK_H

#include "gpu/gl/block.h"

LKAO_BLOCK_BEGIN(HorizonBlock, LKAO_BLOCK_PASS)
float radius;
float screen_radius;  // no longer than any picture
int slice_count, step_count;
float step_exponent;
float thickness;      // no more than makes no difference
float falloff_begin;  // share of the radius
float angle_bias;
int has_even_slices;
int has_equal_angles;  // sectors
uint seed;
LKAO_BLOCK_END(pass)

#endif
