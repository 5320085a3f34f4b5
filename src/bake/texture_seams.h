// Both sides of a cut in the texture made to show the same.
//
// Based on: M. Iwanicki, "Lighting Technology of The Last of Us", SIGGRAPH 2013 Talks: the least change of the texels
// along seams with which bilinear filtering shows the same on both sides.
#pragma once

#include <cstddef>
#include <vector>

#include "bake/texture_charts.h"
#include "bake/texture_layout.h"
#include "bake/texture_map.h"

namespace lkao::bake {

// Largest differences of occlusion between both sides, at points a quarter of a texel or less apart.
struct SeamDifferences {
  double before = 0, after = 0;
};

// Changes only the texels that a bilinear filter reads on a seam: occlusion, and bent normals in object space (those in
// tangent space differ by right). All of these should be known: grow() by 2 texels first. `maps`: one for each of
// layout.udims(). The cost grows with the length of the seams in texels.
SeamDifferences level_seams(const TextureLayout& layout, const TextureCharts& charts, std::vector<TextureMap>& maps);

// The same points, and nothing is changed.
double worst_seam_difference(const TextureLayout& layout, const TextureCharts& charts,
                             const std::vector<TextureMap>& maps);

}  // namespace lkao::bake
