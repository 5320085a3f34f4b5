// Dense tiles of a camera's receivers: what a renderer hands over together.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lkao/ambient_occlusion.h"

namespace lkao::bench {

inline constexpr int kTileSize = 32;  // pixels each way

// The receivers of `tile_count` tiles, tile after tile, in Morton order inside a tile. The tiles are spread evenly over
// those of which at least half of the pixels have a receiver; all of these where there are fewer. `pixels` are the
// pixel numbers (row * width + column) of the receivers, of an image `width` pixels wide.
std::vector<Receiver> choose_tiles(std::span<const Receiver> receivers, std::span<const std::uint32_t> pixels,
                                   int width, int tile_count);

}  // namespace lkao::bench
