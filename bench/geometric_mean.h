// The mean of ratios.
#pragma once

#include <cmath>
#include <span>

namespace lkao::bench {

// Of at least one value, each above 0.
inline double geometric_mean(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += std::log(value);
  return std::exp(sum / static_cast<double>(values.size()));
}

}  // namespace lkao::bench
