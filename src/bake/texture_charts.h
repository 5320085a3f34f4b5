// Which triangles hang together in the texture, and where the surface goes on but the texture does not.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/texture_layout.h"
#include "scene/shared_edges.h"

namespace lkao::bake {

struct TextureCharts {
  // The first triangle of each triangle's chart: of those joined by edges along which both have the same texture
  // coordinates, and lie side by side.
  std::vector<std::uint32_t> firsts;
  // Edges between triangles that are both baked and shade as one surface, with different texture coordinates.
  std::vector<scene::SharedEdge> seams;
};

TextureCharts find_charts(const TextureLayout& layout);

}  // namespace lkao::bake
