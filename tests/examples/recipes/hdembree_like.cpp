#include <limits>

#include "lkao/lkao.h"
#include "recipes.h"

namespace lkao::recipes {

std::vector<float> hdembree_like(std::span<const glm::vec3> points, std::span<const glm::uvec3> triangles,
                                 std::span<const Hit> pixels, int pass, int samples) {
  const OccluderBvh scene({points, triangles});
  const auto seed = static_cast<std::uint64_t>(pass);
  const SamplePattern pattern = SamplePattern::make(PatternKind::sobol, samples, Falloff::constant(), seed);
  const AmbientOcclusion ao(scene, pattern, {.radius = std::numeric_limits<float>::infinity(), .seed = seed});

  std::vector<float> visibility;
  for (std::size_t pixel = 0; pixel < pixels.size(); ++pixel) {
    const OcclusionMask blocked = ao.blocked({pixels[pixel].position, pixels[pixel].normal}, pixel);
    visibility.push_back(1 - static_cast<float>(blocked.count()) / static_cast<float>(samples));
  }
  return visibility;
}

}  // namespace lkao::recipes
