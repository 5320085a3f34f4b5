// Where a pass writes occlusion, and what of it.
#ifndef LKAO_GPU_FRAME_TARGET_BLOCK_H
#define LKAO_GPU_FRAME_TARGET_BLOCK_H

#include "gpu/gl/block.h"

LKAO_BLOCK_BEGIN(TargetBlock, LKAO_BLOCK_TARGET)
vec4 steps;            // from 0 to 1, of each component; 0: they are floats
int first_x, first_y;  // the texel of the picture's pixel (0, 0)
int channel;
int keeps_others;  // the other components of a texel
int is_visibility;
float background;
LKAO_BLOCK_END(target)

#endif
