// Texture units of the splat pass. Compiled as C++ and GLSL: only #define and comments here.
#ifndef LKAO_GPU_SCREEN_SPLAT_UNITS_H
#define LKAO_GPU_SCREEN_SPLAT_UNITS_H

#include "gpu/screen/units.h"

#define LKAO_UNIT_SPLAT_PIXEL_SPHERES (LKAO_SCREEN_UNIT_COUNT + 0)  // 2D array: a sphere a pixel and layer of the scene
#define LKAO_UNIT_SPLAT_SPHERES (LKAO_SCREEN_UNIT_COUNT + 1)        // buffer: those of the far half
#define LKAO_UNIT_SPLAT_SUM (LKAO_SCREEN_UNIT_COUNT + 2)            // 2D: what both halves add up
#define LKAO_SPLAT_UNIT_COUNT (LKAO_SCREEN_UNIT_COUNT + 3)

#endif
