#include "scene/formats/polygons.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include <glm/geometric.hpp>

namespace lkao::scene {

namespace {

// A fan covers a simple polygon exactly where no triangle of it is turned over. `polygon` begins at zero.
bool can_be_fanned(std::span<const glm::dvec2> polygon) {
  constexpr double kRounding = 1e-12;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const glm::dvec2 &p = polygon[i - 1], &q = polygon[i];
    if (p.x * q.y - p.y * q.x < -kRounding * glm::length(p) * glm::length(q)) return false;
  }
  return true;
}

bool is_finite(const glm::dvec2& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

}  // namespace

std::span<const glm::uvec3> PolygonCutter::cut(std::span<const glm::dvec3> corners) {
  triangles_.clear();
  if (corners.size() > 3 && project(corners) && !can_be_fanned(projected_)) {
    ears_.clip(projected_, triangles_);
    return triangles_;
  }
  for (std::size_t i = 2; i < corners.size(); ++i) {
    triangles_.emplace_back(0u, static_cast<std::uint32_t>(i - 1), static_cast<std::uint32_t>(i));
  }
  return triangles_;
}

bool PolygonCutter::project(std::span<const glm::dvec3> corners) {
  const glm::dvec3& first = corners[0];
  glm::dvec3 normal(0.0);
  for (std::size_t i = 2; i < corners.size(); ++i) normal += glm::cross(corners[i - 1] - first, corners[i] - first);
  // Along the normal onto the plane of two coordinates, such that the polygon runs counterclockwise: coordinates in
  // planes of the axes stay as they are, and corners at one place at one place.
  int along = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (std::abs(normal[axis]) > std::abs(normal[along])) along = axis;
  }
  if (!(std::abs(normal[along]) > 0)) return false;
  int right = (along + 1) % 3, up = (along + 2) % 3;
  if (normal[along] < 0) std::swap(right, up);
  const glm::dvec2 slope(normal[right] / normal[along], normal[up] / normal[along]);
  projected_.clear();
  for (const glm::dvec3& corner : corners) {
    const glm::dvec3 p = corner - first;
    projected_.push_back(glm::dvec2(p[right], p[up]) - p[along] * slope);
    if (!is_finite(projected_.back())) return false;
  }
  return true;
}

}  // namespace lkao::scene
