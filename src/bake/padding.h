// What lies between the charts of a map: a filter looks a little beyond them, and a mip chain far beyond.
#pragma once

#include "bake/texture_map.h"
#include "bake/texture_options.h"

namespace lkao::bake {

// Gives texels without occlusion, ring by ring and up to `margin` texels from those that have it, the mean of their
// neighbours (of up to 8) of the ring before, across edges of the map that repeat. Texels that have it stay as they
// are.
void grow(TextureMap& map, int margin, const TextureOptions& options);

// Gives all other texels a value, so that each texel of each level of the mip chain is the mean of those of the level
// below that stand for something alone: each gets the value of the first level in which it has one.
void flood(TextureMap& map);

}  // namespace lkao::bake
