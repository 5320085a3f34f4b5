#include "bake/polygon.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace lkao::bake {
namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

}  // namespace

Polygon::Polygon(const std::array<glm::dvec2, 3>& triangle) {
  for (const glm::dvec2& corner : triangle) add(corner);
}

// Sutherland & Hodgman, "Reentrant Polygon Clipping", Comm. ACM 17(1), 1974, for one line.
Polygon Polygon::cut(const glm::dvec2& normal, double offset) const {
  Polygon result;
  for (std::size_t i = 0; i < count_; ++i) {
    const glm::dvec2 &from = points_[i], &to = points_[i + 1 < count_ ? i + 1 : 0];
    const double height = glm::dot(normal, from) - offset, next_height = glm::dot(normal, to) - offset;
    if (height >= 0) result.add(from);
    if ((height > 0 && next_height < 0) || (height < 0 && next_height > 0)) {
      result.add(from + height / (height - next_height) * (to - from));
    }
  }
  return result;
}

Polygon Polygon::within(const glm::dvec2& lower, const glm::dvec2& upper) const {
  return cut({1, 0}, lower.x).cut({-1, 0}, -upper.x).cut({0, 1}, lower.y).cut({0, -1}, -upper.y);
}

double Polygon::area() const {
  double twice = 0;
  for (std::size_t i = 2; i < count_; ++i) twice += cross(points_[i - 1] - points_[0], points_[i] - points_[0]);
  return 0.5 * std::abs(twice);
}

glm::dvec2 Polygon::centroid() const {
  glm::dvec2 sum(0.0), mean(0.0);
  double weight = 0;
  for (std::size_t i = 0; i < count_; ++i) mean += points_[i] / static_cast<double>(count_);
  for (std::size_t i = 2; i < count_; ++i) {
    const glm::dvec2 b = points_[i - 1] - points_[0], c = points_[i] - points_[0];
    sum += cross(b, c) * (b + c);
    weight += cross(b, c);
  }
  return std::abs(weight) > 0 ? points_[0] + sum / (3 * weight) : mean;
}

}  // namespace lkao::bake
