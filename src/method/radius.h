// An AO radius as users write it: a length, a share of the scene's size, or endless.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "lkao/occluder_bvh.h"
#include "method/read_number.h"

namespace lkao::method {

// Above 0 and finite, also as a float.
inline bool is_length(double number) {
  return number <= double{std::numeric_limits<float>::max()} && static_cast<float>(number) > 0;
}

struct Radius {
  double value = 0;  // a length, perhaps infinite; or percent of the diagonal of the scene's box
  bool is_percentage = false;

  bool operator==(const Radius&) const = default;

  // In the scene's unit. Throws std::invalid_argument where a share of this box is no usable length.
  double in(const Bounds& box) const {
    if (!is_percentage) return value;
    const double diagonal = glm::distance(glm::dvec3(box.lower), glm::dvec3(box.upper));
    const double length = value / 100 * diagonal;
    if (is_length(length)) return length;
    throw std::invalid_argument(fmt::format("{}% of the scene's diagonal {:g} is no usable radius", value, diagonal));
  }
};

// "0.5", "5%" or "inf". Throws std::invalid_argument saying what was expected and what it got.
inline Radius parse_radius(const std::string& text) {
  const bool is_percentage = text.ends_with('%');
  const std::string_view digits = std::string_view(text).substr(0, text.size() - (is_percentage ? 1 : 0));
  const std::optional<double> number = read_number<double>(digits);
  const bool is_endless = number && std::isinf(*number) && *number > 0 && !is_percentage;
  if (is_endless || (number && is_length(*number))) return {*number, is_percentage};
  throw std::invalid_argument(
      fmt::format("expected a length above 0, or inf, or a percentage of the scene's diagonal, got '{}'", text));
}

}  // namespace lkao::method
