// Sums and products of floats without rounding, for the signs of determinants.
//
// Based on: J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates",
// Discrete & Computational Geometry 18, 1997 (Sec. 2.4: expansions).
#pragma once

#include <cmath>
#include <vector>

#include <glm/vec3.hpp>

namespace lkao::tests {

// A real number as an unevaluated sum of doubles that do not overlap, smallest first. Exact for any sums and products
// of up to three float coordinates (or differences of such): they are multiples of 2^-447 and below 2^396, so no double
// overflows or underflows. Slow: meant for the few cases that a bound on rounding cannot settle.
class ExactSum {
 public:
  ExactSum() = default;
  explicit ExactSum(double value) { add(value); }

  int sign() const { return parts_.empty() ? 0 : parts_.back() > 0 ? 1 : -1; }

  friend ExactSum operator+(ExactSum a, const ExactSum& b) {
    for (double part : b.parts_) a.add(part);
    return a;
  }
  friend ExactSum operator-(ExactSum a, const ExactSum& b) {
    for (double part : b.parts_) a.add(-part);
    return a;
  }
  friend ExactSum operator*(const ExactSum& a, const ExactSum& b) {
    ExactSum product;
    for (double x : a.parts_) {
      for (double y : b.parts_) {
        const double high = x * y;
        product.add(std::fma(x, y, -high));
        product.add(high);
      }
    }
    return product;
  }

 private:
  // Shewchuk's Grow-Expansion, leaving out zeros.
  void add(double value) {
    std::size_t kept = 0;
    for (double part : parts_) {
      const double sum = value + part;
      const double of_value = sum - part;
      const double rest = (value - of_value) + (part - (sum - of_value));
      if (rest != 0) parts_[kept++] = rest;
      value = sum;
    }
    parts_.resize(kept);
    if (value != 0) parts_.push_back(value);
  }

  std::vector<double> parts_;
};

struct ExactVec {
  ExactSum x, y, z;

  explicit ExactVec(const glm::vec3& v) : x(v.x), y(v.y), z(v.z) {}
  ExactVec(ExactSum x_sum, ExactSum y_sum, ExactSum z_sum)
      : x(std::move(x_sum)), y(std::move(y_sum)), z(std::move(z_sum)) {}

  friend ExactVec operator-(const ExactVec& a, const ExactVec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
};

inline ExactVec cross(const ExactVec& a, const ExactVec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline ExactSum dot(const ExactVec& a, const ExactVec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

}  // namespace lkao::tests
