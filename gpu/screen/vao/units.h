// Texture and image units of the VAO pass. Compiled as C++ and GLSL: only #define and comments here.
#ifndef LKAO_GPU_SCREEN_VAO_UNITS_H
#define LKAO_GPU_SCREEN_VAO_UNITS_H

#include "gpu/screen/units.h"

#define LKAO_UNIT_VAO_TILES (LKAO_SCREEN_UNIT_COUNT + 0)    // 2D: a value of a tile, LKAO_VAO_*
#define LKAO_UNIT_VAO_COLOURS (LKAO_SCREEN_UNIT_COUNT + 1)  // 2D: GBuffer::colours
#define LKAO_VAO_UNIT_COUNT (LKAO_SCREEN_UNIT_COUNT + 2)

#define LKAO_IMAGE_VAO_BLEEDING LKAO_FRAME_IMAGE_COUNT
#define LKAO_VAO_IMAGE_COUNT (LKAO_FRAME_IMAGE_COUNT + 1)

// Pixels along a side of a tile: those of a group of the shader.
#define LKAO_VAO_TILE 8

#endif
