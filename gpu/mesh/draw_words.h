// How shapes are drawn. Compiled as C++ and GLSL: only #define and comments here.
#ifndef LKAO_GPU_MESH_DRAW_WORDS_H
#define LKAO_GPU_MESH_DRAW_WORDS_H

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
// Triangles that one group of classify.comp takes.
#define LKAO_GROUP_SIZE 64

#endif
