// Which triangles lie in which texels, and over how much of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "bake/polygon.h"
#include "bake/texture_charts.h"
#include "bake/texture_layout.h"

namespace lkao::bake {

// Texels [first, first + size) of a map: what is baked at a time. Part of what a receiver's index is made of.
inline constexpr int kTileSize = 128;
struct Tile {
  std::size_t map = 0;
  glm::ivec2 first{0}, size{0};
};

// The texels of a tile are numbered along a Morton curve: neighbours on the surface are asked about together.
std::uint32_t texel_number(const glm::ivec2& in_tile);
glm::ivec2 texel_place(std::uint32_t number);

// What a texel shows of a triangle.
struct TexelPiece {
  std::uint32_t texel;      // its number
  std::uint32_t placement;  // of TileCoverage::placements
  double area;              // as a share of the texel's
  bool is_whole;            // all of the texel
};

struct TileCoverage {
  Tile tile;
  std::vector<Placement> placements;  // chart by chart: earlier ones have a texel before later ones
  std::vector<TexelPiece> pieces;     // by texel, then placement; those of one texel do not lie over each other
  std::size_t overlapping_texel_count = 0;
};

// Conservative: every texel that a triangle touches, with the area in double precision. What covers less than 1e-9 of
// a texel touches it by rounding only. `placements`: at least those that reach the tile.
TileCoverage cover_tile(const TextureLayout& layout, const TextureCharts& charts, const Tile& tile,
                        std::vector<Placement> placements);

// The part of a triangle in the texel at this place of its map.
Polygon polygon_in_texel(const std::array<glm::dvec2, 3>& corners, const glm::ivec2& texel);

}  // namespace lkao::bake
