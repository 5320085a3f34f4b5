// How far two images of occlusion are apart.
#pragma once

#include <cstddef>
#include <span>

namespace lkao::image {

struct Metrics {
  double mae = 0;
  double rmse = 0;
  double max_error = 0;
  double psnr = 0;              // of values in [0, 1], in dB; +infinity for equal images
  double equal_8bit_share = 0;  // share of values that are equal once rounded to 8 bits
  std::size_t value_count = 0;  // compared
};

// Over the values of both. NaN in both counts as equal and is left out; NaN in one counts as an error of 1.
// Throws std::invalid_argument where the sizes differ.
Metrics compare(std::span<const float> a, std::span<const float> b);

}  // namespace lkao::image
