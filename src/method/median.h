// What counts of several measurements.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace lkao::method {

// Of at least one value; the upper one of the middle two.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace lkao::method
