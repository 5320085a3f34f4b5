// How far a picture of occlusion is from the right one: every figure of the report.
#pragma once

#include <cstddef>
#include <vector>

namespace lkao::bench {

// Over the pixels where both have a receiver. Absolute errors but for the bias.
struct PictureErrors {
  double bias = 0;  // mean of the signed error: above 0, too dark
  double mae = 0, rmse = 0;
  double median = 0, percentile_95 = 0, percentile_99 = 0, largest = 0;
  double psnr = 0;              // dB; infinite for equal pictures
  double equal_8bit_share = 0;  // once both are rounded to 8 bits
  double log_error = 0;         // McGuire 2010, Eq. 14
  std::size_t pixel_count = 0;
};

// Row by row; NaN where there is no receiver. Throws std::invalid_argument where the sizes differ.
PictureErrors errors_of(const std::vector<float>& picture, const std::vector<float>& right, int width, int height);

}  // namespace lkao::bench
