// A space-filling curve over the unit square's plane, so that neighbouring rays get neighbouring bits.
#pragma once

#include <cstdint>
#include <utility>

#include <glm/vec2.hpp>

namespace lkao::lut {

// Position along a Hilbert curve of 2^16 x 2^16 cells over [-1, 1]^2.
inline std::uint32_t hilbert_index(const glm::vec2& point) {
  constexpr int kOrder = 16;
  constexpr float kCells = 1 << kOrder;
  const auto cell = [](float v) {
    const float scaled = (v + 1.0f) * 0.5f * kCells;
    return scaled <= 0            ? 0u
           : scaled >= kCells - 1 ? static_cast<std::uint32_t>(kCells) - 1
                                  : static_cast<std::uint32_t>(scaled);
  };
  std::uint32_t x = cell(point.x), y = cell(point.y), index = 0;
  for (std::uint32_t half = 1u << (kOrder - 1); half > 0; half >>= 1) {
    const std::uint32_t right = (x & half) ? 1 : 0;
    const std::uint32_t top = (y & half) ? 1 : 0;
    index = index << 2 | ((3 * right) ^ top);
    // Turn the quadrant so that the curve enters and leaves it where its neighbours do.
    x &= half - 1;
    y &= half - 1;
    if (top == 0) {
      if (right == 1) {
        x = half - 1 - x;
        y = half - 1 - y;
      }
      std::swap(x, y);
    }
  }
  return index;
}

}  // namespace lkao::lut
