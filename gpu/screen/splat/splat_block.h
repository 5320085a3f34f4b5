// What the splat pass alone knows.
#ifndef LKAO_GPU_SCREEN_SPLAT_SPLAT_BLOCK_H
#define LKAO_GPU_SCREEN_SPLAT_SPLAT_BLOCK_H

#include "gpu/gl/block.h"

LKAO_BLOCK_BEGIN(SplatBlock, LKAO_BLOCK_PASS)
int layer;        // of the scene, whose surfaces are found
int layer_count;  // that the near half looks at
float pixel_sphere_radius;
float near_radius;
float samples_per_pixel;
int max_sample_count;
int has_falling_density;  // of samples
uint seed;
int is_exact;       // the formula: (r / d)^2, or the cap
float scale;        // of what the formula gives
float reach;        // of a sphere of radius 1
float far_begin;    // between these distances the spheres of the far half count
float far_end;      // beyond all that is usable where there is no end
float fade_begin;   // nearer than so many radii nothing of a sphere counts
int blocks_inside;  // a sphere blocks all of a receiver within
LKAO_BLOCK_END(pass)

#endif
