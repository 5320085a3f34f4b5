// Falloff functions, and their inverses as ray lengths.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Eq. 1 and Eq. 3.
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "lkao/sample_pattern.h"

namespace lkao {

Falloff::Falloff(std::string name, Function rho) : name_(std::move(name)), rho_(std::move(rho)) {}

Falloff Falloff::constant() {
  return {"constant", [](double) { return 1.0; }};
}

Falloff Falloff::linear() {
  return {"linear", [](double x) { return 1.0 - x; }};
}

Falloff Falloff::smooth() {
  return {"smooth", [](double x) { return 1.0 - x * x * (3.0 - 2.0 * x); }};
}

Falloff Falloff::exponential(double rate) {
  if (!(rate > 0.0 && rate <= 100.0)) {
    throw std::invalid_argument(fmt::format("falloff rate must be in (0, 100], not {}", rate));
  }
  const double end = std::exp(-rate);
  return {"exponential", [rate, end](double x) { return (std::exp(-rate * x) - end) / (1.0 - end); }};
}

Falloff Falloff::custom(std::string name, Function rho) {
  constexpr int kPlaceCount = 4097;
  if (!rho) throw std::invalid_argument(fmt::format("falloff {} has no function", name));
  double last = 1.0;
  for (int i = 0; i < kPlaceCount; ++i) {
    const double x = static_cast<double>(i) / (kPlaceCount - 1);
    const double value = rho(x);
    if (!(value >= 0.0 && value <= 1.0)) {
      throw std::invalid_argument(fmt::format("falloff {} must stay in [0, 1], but is {} at {}", name, value, x));
    }
    if (value > last) throw std::invalid_argument(fmt::format("falloff {} must not rise, but does at {}", name, x));
    last = value;
  }
  return {std::move(name), std::move(rho)};
}

Falloff Falloff::named(const std::string& name) {
  if (name == "constant") return constant();
  if (name == "linear") return linear();
  if (name == "smooth") return smooth();
  if (name == "exponential") return exponential();
  throw std::invalid_argument(fmt::format("unknown falloff {}; known are constant, linear, smooth, exponential", name));
}

double Falloff::length_at(double u) const {
  if (rho_(1.0) >= u) return 1.0;
  if (rho_(0.0) < u) return 0.0;
  // Invariant: rho(low) >= u > rho(high).
  double low = 0.0, high = 1.0;
  while (high - low > 1e-12) {
    const double middle = 0.5 * (low + high);
    (rho_(middle) >= u ? low : high) = middle;
  }
  return low;
}

}  // namespace lkao
