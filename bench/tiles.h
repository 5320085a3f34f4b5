// Dense tiles of a camera's receivers: what a renderer hands over together.
#pragma once

#include <vector>

#include "bench/study_scenes.h"
#include "lkao/ambient_occlusion.h"
#include "scene/camera.h"

namespace lkao::bench {

inline constexpr int kTileSize = 32;  // pixels each way

// The receivers of `tile_count` tiles, tile after tile, in Morton order inside a tile. The tiles are spread evenly over
// those of which at least half of the pixels have a receiver; all of these where there are fewer.
std::vector<Receiver> choose_tiles(const scene::ReceiverImage& image, int tile_count);

// The same of a scene's view. Throws std::runtime_error, naming the scene, where there is no such tile.
std::vector<Receiver> choose_tiles(const StudyScene& scene, int tile_count);

}  // namespace lkao::bench
