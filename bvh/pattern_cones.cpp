#include "bvh/pattern_cones.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>

namespace lkao::bvh {

PatternCones make_pattern_cones(std::span<const glm::vec3> directions) {
  PatternCones cones;
  constexpr std::size_t kRaysPerCone = PatternCones::kRaysPerCone;
  const std::size_t count = (directions.size() + kRaysPerCone - 1) / kRaysPerCone;
  for (std::size_t i = 0; i < PatternCones::kMaxCount; ++i) {
    const std::size_t first = std::min(i, count - 1) * kRaysPerCone;
    const auto rays = directions.subspan(first, std::min(kRaysPerCone, directions.size() - first));
    glm::dvec3 axis(0);
    for (const glm::vec3& direction : rays) axis += glm::dvec3(direction);
    axis = axis == glm::dvec3(0) ? glm::dvec3(0, 0, 1) : glm::normalize(axis);
    double cosine = 1;
    for (const glm::vec3& direction : rays) cosine = std::min(cosine, glm::dot(axis, glm::dvec3(direction)));
    cosine = std::max(cosine - 1e-6, -1.0);  // rounding
    cones.x[i] = static_cast<float>(axis.x);
    cones.y[i] = static_cast<float>(axis.y);
    cones.z[i] = static_cast<float>(axis.z);
    cones.cosine[i] = static_cast<float>(cosine);
    // Beyond a right angle there is nothing to gain: the whole circle.
    cones.sine[i] = cosine < 0 ? 1.0f : static_cast<float>(std::sqrt(1 - cosine * cosine));
    if (cosine < 0) cones.cosine[i] = -1.0f;
  }
  double lowest = 1;
  for (const glm::vec3& direction : directions) lowest = std::min(lowest, static_cast<double>(direction.z));
  lowest = std::max(lowest - 1e-6, -1.0);
  cones.widest_cosine = static_cast<float>(lowest - 1e-7);
  if (lowest > 0) cones.widest_sine = static_cast<float>(std::sqrt(1 - lowest * lowest) + 1e-7);
  return cones;
}

}  // namespace lkao::bvh
