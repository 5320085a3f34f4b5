#include "bench/rays_radii.h"

#include <algorithm>
#include <limits>

#include <glm/geometric.hpp>

namespace lkao::bench {

bool is_unbounded(float radius, const scene::Mesh& mesh) {
  const Bounds bounds = scene::bounds_of(mesh);
  return radius > glm::length(bounds.upper - bounds.lower);
}

std::vector<float> compared_radii(const StudyScene& scene) {
  std::vector<float> radii = scene.radii;
  const bool has_unbounded =
      std::any_of(radii.begin(), radii.end(), [&](float radius) { return is_unbounded(radius, scene.mesh); });
  if (!has_unbounded) radii.push_back(std::numeric_limits<float>::infinity());
  return radii;
}

}  // namespace lkao::bench
