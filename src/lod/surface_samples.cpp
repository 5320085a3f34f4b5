#include "lod/surface_samples.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace lkao::lod {
namespace {

int steps_for(double length, double spacing) { return std::max(1, static_cast<int>(std::ceil(length / spacing))); }

}  // namespace

bool sample_triangle(const Triangle& triangle, double spacing,
                     const std::function<bool(const glm::dvec3&, double)>& take) {
  const Triangle t = longest_side_first(triangle);
  const double area = area_of(t), side = glm::distance(t.a, t.b), height = side > 0 ? 2 * area / side : 0;
  if (!(height > 0)) return take(t.a, 0);
  const glm::dvec3 across = (t.b - t.a) / side;
  const double foot = glm::dot(t.c - t.a, across);  // of the height: between a and b, since their side is the longest
  const glm::dvec3 up = (t.c - t.a - foot * across) / height;
  const int row_count = steps_for(height, spacing);
  for (int row = 0; row < row_count; ++row) {
    const double low = height * row / row_count, high = height * (row + 1) / row_count;
    const double begin = foot * low / height, end = side - (side - foot) * low / height;
    const double row_area = (end - begin) * (1 - 0.5 / (row_count - row)) * (high - low);
    const int count = steps_for(end - begin, spacing);
    for (int i = 0; i < count; ++i) {
      const double x = begin + (end - begin) * (i + 0.5) / count;
      const double top = x < foot ? height * x / foot : height * (side - x) / (side - foot);
      const double y = 0.5 * (low + std::min(high, std::max(low, top)));
      if (!take(t.a + x * across + y * up, row_area / count)) return false;
    }
  }
  return true;
}

double spacing_for(const Triangle& triangle, const Sampling& sampling) {
  constexpr double kStep = 1.2;
  const double side = longest_side(triangle), height = side > 0 ? 2 * area_of(triangle) / side : 0;
  double spacing = sampling.spacing;
  while (std::ceil(side / spacing) * std::ceil(height / spacing) > std::max(1.0, sampling.most_per_triangle)) {
    spacing *= kStep;
  }
  return spacing;
}

}  // namespace lkao::lod
