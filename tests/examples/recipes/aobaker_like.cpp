#include <limits>

#include "lkao/lkao.h"
#include "recipes.h"

namespace lkao::recipes {

std::vector<float> aobaker_like(std::span<const float> positions, std::span<const float> normals,
                                std::span<const std::uint32_t> indices, int nsamples) {
  const PositionView vertices(positions.data(), positions.size() / 3), directions(normals.data(), normals.size() / 3);
  const OccluderBvh mesh({vertices, IndexView(indices.data(), indices.size() / 3)});
  const AmbientOcclusion ao(mesh, SamplePattern::standard(nsamples, Weighting::uniform),
                            {.radius = std::numeric_limits<float>::infinity()});

  std::vector<Receiver> receivers;
  for (std::size_t i = 0; i < vertices.size(); ++i) receivers.push_back({vertices[i], directions[i]});
  std::vector<float> brightness(receivers.size());
  ao.query(receivers, {.occlusion = brightness});
  for (float& value : brightness) value = 1 - value;
  return brightness;
}

}  // namespace lkao::recipes
