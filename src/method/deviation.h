// How far answers are from those that count as right.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "image/metrics.h"

namespace lkao::method {

struct Deviation {
  std::optional<std::uint64_t> wrong_ray_count;                     // none where one side does not tell ray by ray
  double mismatch_rate = std::numeric_limits<double>::quiet_NaN();  // share of the cast rays
  double mean_change = 0;  // of the occlusion, over receivers where neither is NaN
  image::Metrics error;    // of the occlusion
};

// `wrong_ray_count` of `ray_count` rays.
Deviation deviation(std::span<const float> occlusion, std::span<const float> right,
                    std::optional<std::uint64_t> wrong_ray_count, std::uint64_t ray_count);

}  // namespace lkao::method
