// One direction of the cross-bilateral filter.
#ifndef LKAO_GPU_SCREEN_FILTER_BLOCK_H
#define LKAO_GPU_SCREEN_FILTER_BLOCK_H

#include "gpu/gl/block.h"

LKAO_BLOCK_BEGIN(FilterBlock, LKAO_BLOCK_PASS)
int step_x, step_y;  // from pixel to pixel
int radius;
float gauss;  // the weight of the pixel i steps away is exp(-gauss i^2)
float depth_tolerance;
float normal_sharpness;
float background;
LKAO_BLOCK_END(pass)

#endif
