#include "bench/report/errors.h"

#include <algorithm>
#include <cmath>

#include "bench/volumes_study.h"
#include "image/metrics.h"
#include "method/deviation.h"

namespace lkao::bench {
namespace {

// The value that this share of all is not above: the nearest rank.
double percentile(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return 0;
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::clamp<std::size_t>(rank, 1, sorted.size()) - 1];
}

std::vector<double> sorted_errors(const std::vector<float>& picture, const std::vector<float>& right) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < right.size(); ++i) {
    if (std::isnan(picture[i]) || std::isnan(right[i])) continue;
    errors.push_back(std::fabs(static_cast<double>(picture[i]) - static_cast<double>(right[i])));
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

}  // namespace

PictureErrors errors_of(const std::vector<float>& picture, const std::vector<float>& right, int width, int height) {
  const method::Deviation deviation = method::deviation(picture, right, std::nullopt, 0);
  const std::vector<double> sorted = sorted_errors(picture, right);
  return {.bias = deviation.mean_change,
          .mae = deviation.error.mae,
          .rmse = deviation.error.rmse,
          .median = percentile(sorted, 0.5),
          .percentile_95 = percentile(sorted, 0.95),
          .percentile_99 = percentile(sorted, 0.99),
          .largest = deviation.error.max_error,
          .psnr = deviation.error.psnr,
          .equal_8bit_share = deviation.error.equal_8bit_share,
          .log_error = log_error(picture, right, width, height),
          .pixel_count = deviation.error.value_count};
}

}  // namespace lkao::bench
