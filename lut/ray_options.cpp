#include "lut/ray_options.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "lut/coordinates.h"

namespace lkao::lut {

void check(const RayOptions& options) {
  require(options.radius > 0 && (options.radius <= kLargestCoordinate || std::isinf(options.radius)), "radius",
          "greater than 0 and at most 1e18, or infinity", options.radius);
  require(options.jitter.rotation >= 0 && options.jitter.rotation <= 1, "jitter.rotation", "in [0, 1] turns",
          options.jitter.rotation);
  require(options.jitter.tilt >= 0 && options.jitter.tilt <= 0.5f * std::numbers::pi_v<float>, "jitter.tilt",
          "in [0, pi/2] radians", options.jitter.tilt);
  require(has_automatic_offset(options) || (std::isfinite(options.surface_offset) && options.surface_offset >= 0),
          "surface_offset", "finite and at least 0, or automatic (-1)", options.surface_offset);
  require(
      options.min_distance >= 0 && options.min_distance <= kLargestCoordinate && options.min_distance < options.radius,
      "min_distance", "at least 0, less than the radius and at most 1e18", options.min_distance);
}

void check(const RayOptions& options, const PlaneMaskTable& table) {
  if (std::isinf(options.radius) && &table.directions() != &table) {
    throw std::invalid_argument("radius must be finite, not inf, for a plane mask table of rays of several lengths");
  }
}

}  // namespace lkao::lut
