#include "scene/origin.h"

#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace lkao::scene {

glm::dvec3 choose_origin(std::span<const glm::dvec3> positions) {
  constexpr double kLargest = 1e18;  // of a usable coordinate
  glm::dvec3 lower(std::numeric_limits<double>::infinity());
  glm::dvec3 upper = -lower;
  for (const glm::dvec3& p : positions) {
    if (!(std::abs(p.x) <= kLargest && std::abs(p.y) <= kLargest && std::abs(p.z) <= kLargest)) continue;
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  const double diagonal = glm::distance(lower, upper);
  const double distance = glm::length(0.5 * (lower + upper));
  if (!(lower.x <= upper.x) || distance <= 16 * diagonal || diagonal == 0) return glm::dvec3(0.0);
  const double step = std::pow(10.0, std::ceil(std::log10(diagonal)));
  return step * glm::round(0.5 * (lower + upper) / step);
}

}  // namespace lkao::scene
