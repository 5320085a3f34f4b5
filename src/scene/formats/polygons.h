// Polygons, cut into triangles.
#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace lkao::scene {

// Cuts one polygon after another; keeps its memory between them.
class PolygonCutter {
 public:
  // Corners of n - 2 triangles, as numbers into `corners`, in the polygon's own direction; nothing where there are
  // fewer than three. Triangles without area are among them where the polygon cannot be cut without. Valid until the
  // next call.
  std::span<const glm::uvec3> cut(std::span<const glm::dvec3> corners);

 private:
  std::vector<glm::uvec3> triangles_;
};

}  // namespace lkao::scene
