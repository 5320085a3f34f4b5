// What C++ and GLSL must agree on. Compiled as both: only #define and comments here.
#ifndef LKAO_GPU_CONSTANTS_H
#define LKAO_GPU_CONSTANTS_H

// Texture units.
#define LKAO_UNIT_POSITIONS 0           // buffer: corners of the occluders
#define LKAO_UNIT_TRIANGLES 1           // buffer: their indices
#define LKAO_UNIT_FRAMES 2              // buffer: normal and bounding sphere of each triangle
#define LKAO_UNIT_LIST 3                // buffer: the triangles that are drawn as one kind of shape
#define LKAO_UNIT_DRAWS 4               // buffer: the words of LKAO_DRAW_*
#define LKAO_UNIT_RECEIVERS 5           // 2D array: LKAO_RECEIVER_*
#define LKAO_UNIT_TABLE 6               // buffer: the plane mask table
#define LKAO_UNIT_PATTERN 7             // buffer: direction and length of each ray
#define LKAO_UNIT_MASKS 8               // 2D array: the occlusion masks, 128 rays a layer
#define LKAO_UNIT_PLACE 9               // 2D: what tells a pixel's position
#define LKAO_UNIT_NORMALS 10            // 2D: normals of the pixels
#define LKAO_UNIT_GEOMETRIC_NORMALS 11  // 2D
#define LKAO_UNIT_RANGES 12             // buffer: at which distances each triangle counts
#define LKAO_UNIT_LARGEST 13            // buffer: the largest coordinate of all occluders
#define LKAO_UNIT_COUNT 14

// Shader storage.
#define LKAO_STORAGE_DRAWS 0
#define LKAO_STORAGE_PRISMS 1
#define LKAO_STORAGE_BILLBOARDS 2
#define LKAO_STORAGE_FRAMES 3
#define LKAO_STORAGE_LARGEST 4
#define LKAO_STORAGE_EXTENT 5
#define LKAO_STORAGE_MASKS 0  // and up to seven more: 128 rays each
#define LKAO_STORAGE_COUNT 8

// Words of the buffer of draw commands. Of each kind of shape: the arguments of glDrawArraysIndirect, whose count is
// the number of triangles, and those of glDrawElementsInstancedIndirect, an instance for every batch of triangles.
#define LKAO_DRAW_PRISM_ARRAYS 0
#define LKAO_DRAW_PRISM_ELEMENTS 4
#define LKAO_DRAW_BILLBOARD_ARRAYS 12
#define LKAO_DRAW_BILLBOARD_ELEMENTS 16
#define LKAO_DRAW_WORD_COUNT 24

// Vertices of a prism (two rings of six) and of each of the two polygons of a billboard.
#define LKAO_SHAPE_VERTEX_COUNT 12
// Triangles of a batch: an instance of the indexed draw.
#define LKAO_BATCH_SIZE 64
#define LKAO_GROUP_SIZE 64

// Layers of the texture of receivers.
#define LKAO_RECEIVER_ORIGIN \
  0                            // where the rays start; w: distance along the view, LKAO_NO_RECEIVER where there is none
#define LKAO_RECEIVER_FRAME 1  // three layers: where the pattern's axes go; w: the geometric normal
#define LKAO_RECEIVER_LAYER_COUNT 4
#define LKAO_NO_RECEIVER (-3e38)

// What tells a pixel's position.
#define LKAO_PLACE_DEPTH 0
#define LKAO_PLACE_LINEAR_DEPTH 1
#define LKAO_PLACE_POSITION 2

// Bits of Pass.flags.
#define LKAO_FLAG_TWO_SIDED 1u
#define LKAO_FLAG_CULL_FAR_DEPTH 2u
#define LKAO_FLAG_CULL_SPHERE 4u
#define LKAO_FLAG_CULL_FACING 8u
#define LKAO_FLAG_CULL_PLANE_DISTANCE 16u
#define LKAO_FLAG_CULL_HORIZON 32u
#define LKAO_FLAG_PERSPECTIVE 64u
#define LKAO_FLAG_ZERO_TO_ONE 128u
#define LKAO_FLAG_REVERSED 256u
#define LKAO_FLAG_UNORM_NORMALS 512u
#define LKAO_FLAG_GEOMETRIC_NORMALS 1024u
#define LKAO_FLAG_UNORM_GEOMETRIC_NORMALS 2048u
#define LKAO_FLAG_VIEW_SPACE_NORMALS 4096u
#define LKAO_FLAG_WRITE_OCCLUSION 8192u
#define LKAO_FLAG_WRITE_BENT_NORMALS 16384u
#define LKAO_FLAG_CULL_REACH 32768u
#define LKAO_FLAG_RANGES 65536u
#define LKAO_FLAG_UNBOUNDED 131072u  // the AO radius is infinite

#endif
