// Points spread over triangles, to measure distances at.
#pragma once

#include <functional>

#include <glm/vec3.hpp>

#include "lod/triangle.h"

namespace lkao::lod {

// No point of a triangle is farther from its nearest sample than this many spacings.
inline constexpr double kCoverPerSpacing = 1.12;

// Calls `take(point, area)` for a point in each cell of a grid along the longest side, its cells at most `spacing` wide
// and high; `area` is what each stands for: they add up to the triangle's area. Ends with false where `take` returns
// false.
bool sample_triangle(const Triangle& triangle, double spacing,
                     const std::function<bool(const glm::dvec3&, double)>& take);

// How densely to sample.
struct Sampling {
  double spacing = 0;
  double most_per_triangle = 0;  // on triangles too large for that the spacing is wider
};

// The spacing for this triangle.
double spacing_for(const Triangle& triangle, const Sampling& sampling);

}  // namespace lkao::lod
