// Sums over points that every compiler takes in the same order, at the speed of vectors.
#pragma once

#include <array>
#include <cstddef>

namespace lkao::lut {

inline constexpr std::size_t kLaneCount = 8;
using Lanes = std::array<float, kLaneCount>;

// Calls `add(j, j % kLaneCount)` for every j below `count`, in that order.
template <class Add>
void for_each_in_lanes(std::size_t count, const Add& add) {
  std::size_t j = 0;
  for (; j + kLaneCount <= count; j += kLaneCount) {
    for (std::size_t lane = 0; lane < kLaneCount; ++lane) add(j + lane, lane);
  }
  for (std::size_t lane = 0; j + lane < count; ++lane) add(j + lane, lane);
}

}  // namespace lkao::lut
