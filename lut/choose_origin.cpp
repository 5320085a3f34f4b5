#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lkao/position_view.h"
#include "lut/coordinates.h"

namespace lkao {

glm::dvec3 choose_origin(const PositionView& positions) {
  constexpr double kFar = 16;  // diagonals
  glm::dvec3 lower(std::numeric_limits<double>::infinity());
  glm::dvec3 upper = -lower;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const glm::dvec3 p = positions.exact(i);
    if (!lut::is_in_range(glm::vec3(p))) continue;
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  if (!(lower.x <= upper.x)) return glm::dvec3(0.0);
  const glm::dvec3 centre = 0.5 * (lower + upper);
  const double diagonal = glm::distance(lower, upper);
  if (diagonal == 0 || glm::length(centre) <= kFar * diagonal) return glm::dvec3(0.0);
  const double step = std::pow(10.0, std::ceil(std::log10(diagonal)));
  return step * glm::round(centre / step) + 0.0;  // not -0
}

}  // namespace lkao
