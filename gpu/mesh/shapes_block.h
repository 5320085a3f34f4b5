// The shapes that bound what triangles can darken.
#ifndef LKAO_GPU_MESH_SHAPES_BLOCK_H
#define LKAO_GPU_MESH_SHAPES_BLOCK_H

#include "gpu/gl/block.h"

LKAO_BLOCK_BEGIN(ShapesBlock, LKAO_BLOCK_SHAPES)
mat4 clip_from_world;           // its z is made for depth_at(), see depth.glsl
float radius;                   // the AO radius; for an infinite one see extent.glsl
float billboard_threshold;      // alpha
float relative_surface_offset;  // of the largest coordinate
float min_distance;             // where rays begin to count
float reach;                    // how far shapes go beyond their triangles, in radii
float depth_scale, depth_far;   // see depth.glsl
int is_two_sided;
int has_ranges;
int has_opacities;
int is_unbounded;         // the AO radius is infinite
int is_offset_automatic;  // receivers start farther off by what their positions may be off
LKAO_BLOCK_END(shapes)

#endif
