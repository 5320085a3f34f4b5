// The cross-bilateral filter: what it reads, and how it weighs.
#ifndef LKAO_GPU_SCREEN_FILTER_BLOCK_H
#define LKAO_GPU_SCREEN_FILTER_BLOCK_H

#include "gpu/gl/block.h"

LKAO_BLOCK_BEGIN(FilterBlock, LKAO_BLOCK_PASS)
int step_x, step_y;  // from pixel to pixel of one direction
int sample_step;     // upsampling: pixels from one sample to the next, along both axes
int sample_width, sample_height;
int source_x, source_y;  // the texel of the first sample
int source_channel;
int source_is_visibility;
int radius;
float gauss;  // the weight of what is i pixels away is exp(-gauss i^2)
float depth_tolerance;
float normal_sharpness;
LKAO_BLOCK_END(pass)

#endif
