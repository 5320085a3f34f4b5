// What the mask pass alone knows: jitter, the plane mask table, culls, and what a frame is resolved to.
#ifndef LKAO_GPU_MASKS_MASK_PASS_BLOCK_H
#define LKAO_GPU_MASKS_MASK_PASS_BLOCK_H

#include "gpu/gl/block.h"

LKAO_BLOCK_BEGIN(MaskPassBlock, LKAO_BLOCK_PASS)
int ray_count;
float jitter_rotation;       // in turns
float jitter_tilt;           // the largest, in radians
uint seed_low, seed_high;    // of mix_bits(seed)
uint cube_side;              // of the table, in cells; or:
uint edge_side, slice_side;  // ... of the cube maps of edges and of each slice
uint slice_count;
uint first_slice;      // the cells before the slices: those of edges
uint slice_size;       // cells of a slice
uint first_direction;  // the cells before those for rays of one length; 0 where all rays are of one
int culls_far_depth, culls_by_sphere, culls_by_facing, culls_by_plane, culls_by_horizon, culls_by_reach;
int writes_occlusion, writes_bent_normals;
LKAO_BLOCK_END(pass)

#endif
