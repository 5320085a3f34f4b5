#include "bench/tiles.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <utility>

namespace lkao::bench {
namespace {

constexpr std::size_t kDenseCount = kTileSize * kTileSize / 2;

// Interleaves the bits of the pixel's place in its tile.
std::uint32_t morton(std::uint32_t x, std::uint32_t y) {
  std::uint32_t code = 0;
  for (int bit = 0; (kTileSize >> bit) > 1; ++bit) {
    code |= (x >> bit & 1u) << (2 * bit) | (y >> bit & 1u) << (2 * bit + 1);
  }
  return code;
}

// Morton code and pixel of each receiver.
using Tile = std::vector<std::pair<std::uint32_t, std::size_t>>;

// The dense ones, row by row.
std::vector<Tile> find_dense_tiles(const scene::ReceiverImage& image) {
  const auto width = static_cast<std::uint32_t>(image.width);
  std::map<std::pair<std::uint32_t, std::uint32_t>, Tile> tiles;  // by row and column
  for (std::size_t pixel = 0; pixel < image.receivers.size(); ++pixel) {
    if (!image.sees(pixel)) continue;
    const std::uint32_t x = static_cast<std::uint32_t>(pixel) % width;
    const std::uint32_t y = static_cast<std::uint32_t>(pixel) / width;
    tiles[{y / kTileSize, x / kTileSize}].emplace_back(morton(x % kTileSize, y % kTileSize), pixel);
  }
  std::vector<Tile> dense;
  for (auto& [place, tile] : tiles) {
    if (tile.size() >= kDenseCount) dense.push_back(std::move(tile));
  }
  return dense;
}

}  // namespace

std::vector<Receiver> choose_tiles(const scene::ReceiverImage& image, int tile_count) {
  std::vector<Tile> dense = find_dense_tiles(image);
  const std::size_t chosen_count = std::min(dense.size(), static_cast<std::size_t>(tile_count));
  std::vector<Receiver> chosen;
  for (std::size_t i = 0; i < chosen_count; ++i) {
    Tile& tile = dense[(2 * i + 1) * dense.size() / (2 * chosen_count)];
    std::sort(tile.begin(), tile.end());
    for (const auto& [code, pixel] : tile) chosen.push_back(image.receivers[pixel]);
  }
  return chosen;
}

std::vector<Receiver> choose_tiles(const StudyScene& scene, int tile_count) {
  std::vector<Receiver> receivers = choose_tiles(scene.view, tile_count);
  if (receivers.empty()) throw std::runtime_error(scene.name + ": no tile of the picture is half full of receivers");
  return receivers;
}

}  // namespace lkao::bench
