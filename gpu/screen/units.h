// Texture units of passes in screen space. Compiled as C++ and GLSL: only #define and comments here.
#ifndef LKAO_GPU_SCREEN_UNITS_H
#define LKAO_GPU_SCREEN_UNITS_H

#include "gpu/frame/units.h"

#define LKAO_UNIT_UNFILTERED (LKAO_FRAME_UNIT_COUNT + 0)  // 2D: the occlusion
#define LKAO_FILTER_UNIT_COUNT (LKAO_FRAME_UNIT_COUNT + 1)

#define LKAO_UNIT_SCREEN_RECEIVERS (LKAO_FRAME_UNIT_COUNT + 0)  // 2D array: LKAO_SCREEN_*
#define LKAO_SCREEN_UNIT_COUNT (LKAO_FRAME_UNIT_COUNT + 1)

// Layers of the receivers in view space.
#define LKAO_SCREEN_POSITION 0  // w: 1, or 0 where there is none
#define LKAO_SCREEN_NORMAL 1    // of unit length
#define LKAO_SCREEN_LAYER_COUNT 2

#endif
