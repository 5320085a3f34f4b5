// Which numbers may be coordinates: the one judgement that the whole project shares.
#pragma once

#include <cmath>

#include <glm/vec3.hpp>

namespace lkao::lut {

// True where no coordinate is NaN or infinite.
inline bool is_finite(const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

// True where every coordinate is a number of at most kLargestCoordinate: beyond it the arithmetic of single precision
// overflows.
inline constexpr float kLargestCoordinate = 1e18f;
inline bool is_in_range(const glm::vec3& p) {
  return std::fabs(p.x) <= kLargestCoordinate && std::fabs(p.y) <= kLargestCoordinate &&
         std::fabs(p.z) <= kLargestCoordinate;
}
inline bool is_in_range(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return is_in_range(a) && is_in_range(b) && is_in_range(c);
}

}  // namespace lkao::lut
