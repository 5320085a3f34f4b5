// Texture units of the splat pass. Compiled as C++ and GLSL: only #define and comments here.
#ifndef LKAO_GPU_SCREEN_SPLAT_UNITS_H
#define LKAO_GPU_SCREEN_SPLAT_UNITS_H

#include "gpu/frame/units.h"

#define LKAO_UNIT_SPLAT_RECEIVERS (LKAO_FRAME_UNIT_COUNT + 0)      // 2D array: LKAO_RECEIVER_*
#define LKAO_UNIT_SPLAT_PIXEL_SPHERES (LKAO_FRAME_UNIT_COUNT + 1)  // 2D array: a sphere a pixel and layer of the scene
#define LKAO_UNIT_SPLAT_SPHERES (LKAO_FRAME_UNIT_COUNT + 2)        // buffer: those of the far half
#define LKAO_UNIT_SPLAT_SUM (LKAO_FRAME_UNIT_COUNT + 3)            // 2D: what both halves add up
#define LKAO_SPLAT_UNIT_COUNT (LKAO_FRAME_UNIT_COUNT + 4)

// Layers of the receivers, both in view space.
#define LKAO_RECEIVER_POSITION 0  // w: 1, or 0 where there is none
#define LKAO_RECEIVER_NORMAL 1    // of unit length
#define LKAO_RECEIVER_LAYER_COUNT 2

#endif
