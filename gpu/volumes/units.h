// Texture units and shader storage of the volume pass. Compiled as C++ and GLSL: only #define and comments here.
#ifndef LKAO_GPU_VOLUMES_UNITS_H
#define LKAO_GPU_VOLUMES_UNITS_H

#include "gpu/mesh/units.h"

#define LKAO_UNIT_ORIGINS (LKAO_MESH_UNIT_COUNT + 0)        // 2D: where receivers are; w: 0 where there is none
#define LKAO_UNIT_AXES (LKAO_MESH_UNIT_COUNT + 1)           // 2D: their shading normals; w: see receivers.frag.glsl
#define LKAO_UNIT_UPS (LKAO_MESH_UNIT_COUNT + 2)            // 2D: their geometric normals
#define LKAO_UNIT_ACCESSIBILITY (LKAO_MESH_UNIT_COUNT + 3)  // 2D: the paper's buffer
#define LKAO_UNIT_BASES (LKAO_MESH_UNIT_COUNT + 4)          // buffer: the bases of volumes that are kept
#define LKAO_VOLUME_PASS_UNIT_COUNT (LKAO_MESH_UNIT_COUNT + 5)

// Of extend.comp.glsl, after triangles are classified.
#define LKAO_STORAGE_BASES 0

// Vertices of a volume: the base's corners, then the cover's.
#define LKAO_VOLUME_VERTEX_COUNT 6
// Vectors of four floats that a volume's base takes.
#define LKAO_BASE_TEXELS 3

#endif
