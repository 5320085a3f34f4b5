// Vectors of 4 floats and boxes of them, what the builder computes with: points in lanes 0 to 2.
#pragma once

#include <cstdint>

#include "bvh/bounds.h"

namespace lkao::bvh {

// Of any processor: an extension of GCC and Clang.
using Lanes = float __attribute__((vector_size(16)));
using IntLanes = std::int32_t __attribute__((vector_size(16)));

inline Lanes min(Lanes a, Lanes b) { return a < b ? a : b; }
inline Lanes max(Lanes a, Lanes b) { return a > b ? a : b; }
inline Lanes abs(Lanes a) { return max(a, -a); }

// Empty where lower > upper. The last lane has no meaning.
struct Box {
  Lanes lower;
  Lanes upper;
};

inline constexpr Box empty_box() {
  return {Lanes{kInfinity, kInfinity, kInfinity, 0}, Lanes{-kInfinity, -kInfinity, -kInfinity, 0}};
}

inline Box merge(const Box& a, const Box& b) { return {min(a.lower, b.lower), max(a.upper, b.upper)}; }
inline Box merge(const Box& box, Lanes point) { return {min(box.lower, point), max(box.upper, point)}; }
inline Box intersect(const Box& a, const Box& b) { return {max(a.lower, b.lower), min(a.upper, b.upper)}; }

inline bool is_empty(const Box& box) {
  return box.lower[0] > box.upper[0] || box.lower[1] > box.upper[1] || box.lower[2] > box.upper[2];
}

// Half of its surface. Of boxes that are not empty.
inline float half_area(const Box& box) {
  const Lanes size = box.upper - box.lower;
  return size[0] * (size[1] + size[2]) + size[1] * size[2];
}

}  // namespace lkao::bvh
