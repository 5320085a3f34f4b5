#include <algorithm>
#include <limits>

#include "lkao/lkao.h"
#include "recipes.h"

namespace lkao::recipes {

std::vector<double> libigl_like(std::span<const double> V, std::span<const int> F, std::span<const double> P,
                                std::span<const double> N, int n) {
  const glm::dvec3 origin = choose_origin({V.data(), V.size() / 3, glm::dvec3(0)});
  const OccluderBvh mesh({PositionView(V.data(), V.size() / 3, origin), IndexView(F.data(), F.size() / 3)});
  const SamplePattern& directions = SamplePattern::standard(std::min(n, kMaxRayCount), Weighting::uniform);
  const AmbientOcclusion ao(mesh, directions, {.radius = std::numeric_limits<float>::infinity()});

  const PositionView points(P.data(), P.size() / 3, origin), normals(N.data(), N.size() / 3, glm::dvec3(0));
  std::vector<Receiver> receivers;
  for (std::size_t i = 0; i < points.size(); ++i) receivers.push_back({points[i], normals[i]});
  std::vector<float> occlusion(receivers.size());
  ao.query(receivers, {.occlusion = occlusion});
  return {occlusion.begin(), occlusion.end()};
}

}  // namespace lkao::recipes
