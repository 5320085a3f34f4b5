#include "tiles.h"

#include <algorithm>
#include <cstddef>
#include <map>
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

// Morton code and number of each receiver.
using Tile = std::vector<std::pair<std::uint32_t, std::size_t>>;

// The dense ones, row by row.
std::vector<Tile> find_dense_tiles(std::span<const std::uint32_t> pixels, std::uint32_t width) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Tile> tiles;  // by row and column
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::uint32_t x = pixels[i] % width;
    const std::uint32_t y = pixels[i] / width;
    tiles[{y / kTileSize, x / kTileSize}].emplace_back(morton(x % kTileSize, y % kTileSize), i);
  }
  std::vector<Tile> dense;
  for (auto& [place, tile] : tiles) {
    if (tile.size() >= kDenseCount) dense.push_back(std::move(tile));
  }
  return dense;
}

}  // namespace

std::vector<Receiver> choose_tiles(std::span<const Receiver> receivers, std::span<const std::uint32_t> pixels,
                                   int width, int tile_count) {
  std::vector<Tile> dense = find_dense_tiles(pixels, static_cast<std::uint32_t>(width));
  const std::size_t chosen_count = std::min(dense.size(), static_cast<std::size_t>(tile_count));
  std::vector<Receiver> chosen;
  for (std::size_t i = 0; i < chosen_count; ++i) {
    Tile& tile = dense[(2 * i + 1) * dense.size() / (2 * chosen_count)];
    std::sort(tile.begin(), tile.end());
    for (const auto& [code, receiver] : tile) chosen.push_back(receivers[receiver]);
  }
  return chosen;
}

}  // namespace lkao::bench
