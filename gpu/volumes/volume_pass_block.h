// What the volume pass alone knows.
#ifndef LKAO_GPU_VOLUMES_VOLUME_PASS_BLOCK_H
#define LKAO_GPU_VOLUMES_VOLUME_PASS_BLOCK_H

#include "gpu/gl/block.h"

LKAO_BLOCK_BEGIN(VolumePassBlock, LKAO_BLOCK_PASS)
vec4 compensation;  // occlusion o becomes x o + y o^2 + z o^3
int clamps_extensions;
LKAO_BLOCK_END(pass)

#endif
