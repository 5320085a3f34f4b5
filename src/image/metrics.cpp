#include "image/metrics.h"

#include <cmath>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace lkao::image {
namespace {

double error_of(float a, float b) {
  if (std::isnan(a) || std::isnan(b)) return 1;
  if (a == b) return 0;  // infinities too, whose difference would be NaN
  return std::abs(static_cast<double>(a) - static_cast<double>(b));
}

bool equal_at_8_bits(float a, float b) {
  if (std::isnan(a) || std::isnan(b)) return false;
  const auto rounded = [](float value) { return std::lround(std::clamp(value, 0.0f, 1.0f) * 255); };
  return rounded(a) == rounded(b);
}

}  // namespace

Metrics compare(std::span<const float> a, std::span<const float> b) {
  if (a.size() != b.size()) {
    throw std::invalid_argument(fmt::format("cannot compare {} values with {}", a.size(), b.size()));
  }
  Metrics metrics;
  double sum = 0;
  double sum_of_squares = 0;
  std::size_t equal_count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a[i]) && std::isnan(b[i])) continue;
    const double error = error_of(a[i], b[i]);
    sum += error;
    sum_of_squares += error * error;
    metrics.max_error = std::max(metrics.max_error, error);
    equal_count += equal_at_8_bits(a[i], b[i]) ? 1 : 0;
    ++metrics.value_count;
  }
  const auto count = static_cast<double>(std::max<std::size_t>(metrics.value_count, 1));
  metrics.mae = sum / count;
  metrics.rmse = std::sqrt(sum_of_squares / count);
  metrics.psnr = sum_of_squares == 0 ? std::numeric_limits<double>::infinity() : -20 * std::log10(metrics.rmse);
  metrics.equal_8bit_share = metrics.value_count == 0 ? 1 : static_cast<double>(equal_count) / count;
  return metrics;
}

}  // namespace lkao::image
