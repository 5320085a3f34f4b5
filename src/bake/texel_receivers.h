// Receivers of texels.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>

#include "bake/tangent_frames.h"
#include "bake/texel_coverage.h"
#include "lkao/receiver.h"

namespace lkao::bake {

// Of one tile, by texel.
struct TexelReceivers {
  std::vector<Receiver> receivers;
  std::vector<std::uint32_t> texels;  // of each receiver: the texel's number in the tile
  std::vector<float> weights;         // and its share of the texel
  std::vector<glm::mat3> frames;      // and, where asked for, what is tangent, bitangent and normal there
  std::size_t missed_count = 0;       // TextureReport::missed_receiver_count
};

// A piece of a texel stands for its area by points in its middle, or in the middles of the parts that cells of the
// texel cut it into (TextureOptions::grid); moved a little where they are too near to an edge of their triangle. A
// shading normal is interpolated; beside it is the facet's. `frames` may be null.
TexelReceivers make_receivers(const TextureLayout& layout, const TileCoverage& coverage, double clearance,
                              const TangentFrames* frames);

}  // namespace lkao::bake
