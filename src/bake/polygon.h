// Small convex polygons, cut by lines.
#pragma once

#include <array>
#include <cstddef>

#include <glm/vec2.hpp>

namespace lkao::bake {

// A triangle that is cut by all sides of a texel, and those of a part of it, has at most 11 corners; 12 by an edge of
// another triangle each, of a texel's piece.
class Polygon {
 public:
  Polygon() = default;
  explicit Polygon(const std::array<glm::dvec2, 3>& triangle);

  bool is_empty() const { return count_ < 3; }
  std::size_t size() const { return count_; }
  const glm::dvec2& operator[](std::size_t i) const { return points_[i]; }

  // The part where dot(normal, p) >= offset.
  Polygon cut(const glm::dvec2& normal, double offset) const;
  // The part in [lower, upper].
  Polygon within(const glm::dvec2& lower, const glm::dvec2& upper) const;

  // At least 0, whichever way the corners go round.
  double area() const;
  // Of a polygon without area: the mean of its corners.
  glm::dvec2 centroid() const;

 private:
  // By rounding a line can cross a sliver more than twice: what is then too much is no area.
  void add(const glm::dvec2& point) {
    if (count_ < points_.size()) points_[count_++] = point;
  }

  std::array<glm::dvec2, 16> points_;
  std::size_t count_ = 0;
};

}  // namespace lkao::bake
