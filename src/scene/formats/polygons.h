// Polygons, cut into triangles.
#pragma once

#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "scene/formats/ear_clipper.h"

namespace lkao::scene {

// Cuts one polygon after another; keeps its memory between them.
class PolygonCutter {
 public:
  // Corners of n - 2 triangles, as numbers into `corners`, in the polygon's own direction; nothing where there are
  // fewer than three. A fan around the first corner where that is right, seen along the polygon's normal (Newell's, the
  // mean over its edges), and where there is no normal; by clipping ears otherwise. Triangles without area are among
  // them where the polygon cannot be cut without. Valid until the next call.
  std::span<const glm::uvec3> cut(std::span<const glm::dvec3> corners);

 private:
  // False where the polygon has no usable normal.
  bool project(std::span<const glm::dvec3> corners);

  std::vector<glm::uvec3> triangles_;
  std::vector<glm::dvec2> projected_;
  EarClipper ears_;
};

}  // namespace lkao::scene
