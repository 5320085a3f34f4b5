// Texture units of passes in screen space. Compiled as C++ and GLSL: only #define and comments here.
#ifndef LKAO_GPU_SCREEN_UNITS_H
#define LKAO_GPU_SCREEN_UNITS_H

#include "gpu/frame/units.h"

#define LKAO_UNIT_UNFILTERED (LKAO_FRAME_UNIT_COUNT + 0)  // 2D: the occlusion
#define LKAO_FILTER_UNIT_COUNT (LKAO_FRAME_UNIT_COUNT + 1)

#endif
