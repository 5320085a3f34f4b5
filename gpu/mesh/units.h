// Texture units and shader storage of what is known of a mesh. Compiled as C++ and GLSL: only #define and comments
// here.
#ifndef LKAO_GPU_MESH_UNITS_H
#define LKAO_GPU_MESH_UNITS_H

#include "gpu/frame/units.h"

// All of them buffers.
#define LKAO_UNIT_POSITIONS (LKAO_FRAME_UNIT_COUNT + 0)   // corners of the triangles
#define LKAO_UNIT_TRIANGLES (LKAO_FRAME_UNIT_COUNT + 1)   // their indices
#define LKAO_UNIT_RANGES (LKAO_FRAME_UNIT_COUNT + 2)      // at which distances each triangle counts
#define LKAO_UNIT_FRAMES (LKAO_FRAME_UNIT_COUNT + 3)      // normal and bounding sphere of each triangle
#define LKAO_UNIT_LIST (LKAO_FRAME_UNIT_COUNT + 4)        // the triangles that are drawn as one kind of shape
#define LKAO_UNIT_DRAWS (LKAO_FRAME_UNIT_COUNT + 5)       // the words of LKAO_DRAW_*
#define LKAO_UNIT_LARGEST (LKAO_FRAME_UNIT_COUNT + 6)     // the largest coordinate of all triangles
#define LKAO_MESH_UNIT_COUNT (LKAO_FRAME_UNIT_COUNT + 7)  // the units of other folders follow

// Written while triangles are classified; free afterwards.
#define LKAO_STORAGE_DRAWS 0
#define LKAO_STORAGE_PRISMS 1
#define LKAO_STORAGE_BILLBOARDS 2
#define LKAO_STORAGE_FRAMES 3
#define LKAO_STORAGE_LARGEST 4
#define LKAO_STORAGE_EXTENT 5
#define LKAO_STORAGE_OPACITIES 6
#define LKAO_MESH_STORAGE_COUNT 7

// Of transform.comp.glsl, which runs between passes.
#define LKAO_STORAGE_WORLD 0
#define LKAO_STORAGE_LOCAL 1
#define LKAO_STORAGE_INSTANCES 2
#define LKAO_TRANSFORM_STORAGE_COUNT 3

#endif
