#include "method/deviation.h"

#include <cmath>
#include <cstddef>

namespace lkao::method {
namespace {

double mean_change(std::span<const float> values, std::span<const float> from) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i]) || std::isnan(from[i])) continue;
    sum += static_cast<double>(values[i]) - static_cast<double>(from[i]);
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

}  // namespace

Deviation deviation(std::span<const float> occlusion, std::span<const float> right,
                    std::optional<std::uint64_t> wrong_ray_count, std::uint64_t ray_count) {
  Deviation result;
  result.error = image::compare(occlusion, right);  // first: it checks the sizes
  result.mean_change = mean_change(occlusion, right);
  result.wrong_ray_count = wrong_ray_count;
  if (wrong_ray_count) {
    result.mismatch_rate = ray_count > 0 ? static_cast<double>(*wrong_ray_count) / static_cast<double>(ray_count) : 0;
  }
  return result;
}

}  // namespace lkao::method
