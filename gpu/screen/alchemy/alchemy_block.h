// What the Alchemy pass alone knows. Lengths are in AO radii.
#ifndef LKAO_GPU_SCREEN_ALCHEMY_ALCHEMY_BLOCK_H
#define LKAO_GPU_SCREEN_ALCHEMY_ALCHEMY_BLOCK_H

#include "gpu/gl/block.h"

// DiscPattern.
#define LKAO_PATTERN_JITTERED 0
#define LKAO_PATTERN_SPIRAL 1
#define LKAO_PATTERN_EVEN_SPIRAL 2

// ObscuranceFalloff.
#define LKAO_FALLOFF_CUT_OFF 0
#define LKAO_FALLOFF_SMOOTH 1
#define LKAO_FALLOFF_MEDIUM 2
#define LKAO_FALLOFF_LOW 3

LKAO_BLOCK_BEGIN(AlchemyBlock, LKAO_BLOCK_PASS)
float radius;  // in the unit of the positions
float intensity;
float bias;               // a share of the distance along the view, in the unit of the positions,
float parallel_distance;  // or of this, of a camera without perspective
float epsilon;
float contrast;
int falloff;
int samples_per_band;
int max_band_count;
float full_radius;  // in pixels
int pattern;
float spiral_turns;
uint seed;
LKAO_BLOCK_END(pass)

#endif
