#include "scene/radius.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace lkao::scene {

namespace {

constexpr double kSmallShare = 0.014;
constexpr double kLargeShare = 0.042;

// Two significant digits: 0.747... becomes 0.75.
float round_to_two_digits(double value) {
  if (!(value > 0) || !std::isfinite(value)) return 0;
  const double step = std::pow(10.0, std::floor(std::log10(value)) - 1);
  return static_cast<float>(std::round(value / step) * step);
}

}  // namespace

SuggestedRadii suggest_radii(const Bounds& bounds) {
  const double diagonal = glm::length(glm::dvec3(bounds.upper) - glm::dvec3(bounds.lower));
  if (!(bounds.lower.x <= bounds.upper.x)) return {};
  return {round_to_two_digits(kSmallShare * diagonal), round_to_two_digits(kLargeShare * diagonal)};
}

}  // namespace lkao::scene
