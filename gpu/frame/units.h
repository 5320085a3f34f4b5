// Texture and image units of what any pass sees and writes. Compiled as C++ and GLSL: only #define and comments here.
#ifndef LKAO_GPU_FRAME_UNITS_H
#define LKAO_GPU_FRAME_UNITS_H

#define LKAO_UNIT_PLACE 0              // 2D: what tells a pixel's position
#define LKAO_UNIT_NORMALS 1            // 2D: normals of the pixels
#define LKAO_UNIT_GEOMETRIC_NORMALS 2  // 2D
#define LKAO_UNIT_TARGET 3             // 2D: the target, where its other components are to be kept
#define LKAO_FRAME_UNIT_COUNT 4        // the units of other folders follow

#define LKAO_IMAGE_TARGET 0
#define LKAO_FRAME_IMAGE_COUNT 1

#endif
