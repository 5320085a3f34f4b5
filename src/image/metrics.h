// How far two images of occlusion are apart.
#pragma once

#include <cstddef>
#include <span>

namespace lkao::image {

struct Metrics {
  double mae = 0;               // mean absolute error
  double rmse = 0;              // root of the mean squared error
  double max_error = 0;         // largest absolute error
  double psnr = 0;              // of values in [0, 1], in dB; +infinity for equal images
  double equal_8bit_share = 0;  // share of values that are equal once clamped to [0, 1] and rounded to 8 bits
  std::size_t value_count = 0;  // compared
};

// Over the values of both, in double precision. NaN in both counts as equal and is left out; NaN in one counts as an
// error of 1 and as unequal. Equal infinities are equal. Where nothing is left to compare, the images are equal.
// Throws std::invalid_argument where the sizes differ.
Metrics compare(std::span<const float> a, std::span<const float> b);

}  // namespace lkao::image
