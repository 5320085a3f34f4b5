// Texture units, images and shader storage of the mask pass. Compiled as C++ and GLSL: only #define and comments here.
#ifndef LKAO_GPU_MASKS_UNITS_H
#define LKAO_GPU_MASKS_UNITS_H

#include "gpu/mesh/units.h"

#define LKAO_UNIT_RECEIVERS (LKAO_MESH_UNIT_COUNT + 0)  // 2D array: LKAO_RECEIVER_*
#define LKAO_UNIT_TABLE (LKAO_MESH_UNIT_COUNT + 1)      // buffer: the plane mask table
#define LKAO_UNIT_PATTERN (LKAO_MESH_UNIT_COUNT + 2)    // buffer: direction and length of each ray
#define LKAO_UNIT_MASKS (LKAO_MESH_UNIT_COUNT + 3)      // 2D array: the occlusion masks, 128 rays a layer
#define LKAO_MASK_PASS_UNIT_COUNT (LKAO_MESH_UNIT_COUNT + 4)

// Images. While it draws, the first one is a texture of the pass's own.
#define LKAO_IMAGE_BENT_NORMALS (LKAO_FRAME_IMAGE_COUNT + 0)
#define LKAO_MASK_PASS_IMAGE_COUNT (LKAO_FRAME_IMAGE_COUNT + 1)

// The masks in shader storage instead: 128 rays each.
#define LKAO_STORAGE_MASKS 0
#define LKAO_STORAGE_MASKS_COUNT 8

// Layers of the texture of receivers. Origin: where the rays start; w: distance along the view, LKAO_NO_RECEIVER where
// there is none. Frame, three layers: where the pattern's axes go; w: the geometric normal.
#define LKAO_RECEIVER_ORIGIN 0
#define LKAO_RECEIVER_FRAME 1
#define LKAO_RECEIVER_LAYER_COUNT 4
#define LKAO_NO_RECEIVER (-3e38)

#endif
