#include "lut/plane_cells.h"

#include <array>

#include <glm/geometric.hpp>

namespace lkao::lut {
namespace {

// The direction in the corner (x, y) of a face of a cube map.
glm::dvec3 cube_map_direction(std::uint32_t face, std::uint32_t x, std::uint32_t y, std::uint32_t side) {
  const double along = face % 2 == 0 ? 1 : -1, u = unwarp(2.0 * x / side - 1.0), v = unwarp(2.0 * y / side - 1.0);
  switch (face / 2) {
    case 0:
      return glm::normalize(glm::dvec3(along, u, v));
    case 1:
      return glm::normalize(glm::dvec3(v, along, u));
    default:
      return glm::normalize(glm::dvec3(u, v, along));
  }
}

// Sets the angle so that the cone around the axis holds all corners, and with them the convex cell between them.
template <std::size_t kCount>
void set_angle(PlaneCell& cell, const glm::dvec3& axis, const std::array<glm::dvec3, kCount>& corners) {
  double least_cos = 1;
  for (const glm::dvec3& corner : corners) least_cos = std::min(least_cos, glm::dot(axis, glm::normalize(corner)));
  cell.axis = axis;
  cell.angle_cos = static_cast<float>(least_cos);
  cell.angle_sin = static_cast<float>(std::sqrt(1.0 - least_cos * least_cos));
}

PlaneCell cube_map_geometry(std::uint32_t cell, std::uint32_t side) {
  const std::uint32_t x = cell % side, y = cell / side % side, face = cell / side / side;
  const std::array<glm::dvec3, 4> corners{
      cube_map_direction(face, x, y, side), cube_map_direction(face, x + 1, y, side),
      cube_map_direction(face, x, y + 1, side), cube_map_direction(face, x + 1, y + 1, side)};
  PlaneCell geometry;
  geometry.is_used = true;
  set_angle(geometry, glm::normalize(corners[0] + corners[1] + corners[2] + corners[3]), corners);
  return geometry;
}

// The distance at a place among the slices: the inverse of slice_place.
float slice_distance(std::uint32_t border, std::uint32_t slice_count) {
  const double root = 0.5 * (std::sqrt(9.0 - 8.0 * border / slice_count) - 1.0);
  return static_cast<float>(1.0 - root * root);
}

}  // namespace

PlaneCells::PlaneCells(PlaneAddressing addressing, int resolution) : addressing_(addressing), resolution_(resolution) {
  const auto side = static_cast<std::uint32_t>(resolution);
  cell_count_ = side * side * side;
  if (addressing == PlaneAddressing::cube) return;
  // A third of the cells for the map of edges, and how many slices, were found by measuring (lut/README.md).
  const auto side_of = [](double count) { return static_cast<std::uint32_t>(std::lround(std::sqrt(count / 6.0))); };
  edge_side_ = side_of(cell_count_ / 3.0);
  edge_cell_count_ = 6 * edge_side_ * edge_side_;
  slice_count_ = side / 2;
  slice_side_ = side_of(static_cast<double>(cell_count_ - edge_cell_count_) / slice_count_);
  slice_cell_count_ = 6 * slice_side_ * slice_side_;
  cell_count_ = edge_cell_count_ + slice_count_ * slice_cell_count_;
}

PlaneCell PlaneCells::geometry(std::uint32_t cell) const {
  if (addressing_ == PlaneAddressing::cube) return cube_geometry(cell);
  if (cell < edge_cell_count_) return cube_map_geometry(cell, edge_side_);
  const std::uint32_t slice = (cell - edge_cell_count_) / slice_cell_count_;
  PlaneCell geometry = cube_map_geometry((cell - edge_cell_count_) % slice_cell_count_, slice_side_);
  geometry.nearest_distance = slice_distance(slice, slice_count_);
  geometry.farthest_distance = slice_distance(slice + 1, slice_count_);
  geometry.distance = 0.5f * (geometry.nearest_distance + geometry.farthest_distance);
  return geometry;
}

PlaneCell PlaneCells::cube_geometry(std::uint32_t cell) const {
  const auto side = static_cast<std::uint32_t>(resolution_);
  const glm::dvec3 place(cell % side, cell / side % side, cell / side / side);
  const double half = 1.0 / (resolution_ - 1);
  const glm::dvec3 middle = place * (2.0 * half) - 1.0;
  // d_norm is the largest component of the address; over the cell it spans this.
  const glm::dvec3 extent = glm::abs(middle);
  const double largest = std::max(extent.x, std::max(extent.y, extent.z));
  const auto distance_of = [](double d_norm) {
    return static_cast<float>(std::clamp((1.0 - d_norm) / kDistanceShare, 0.0, 1.0));
  };
  PlaneCell geometry;
  if (largest + half < 1.0 - kDistanceShare) return geometry;
  geometry.is_used = true;
  geometry.distance = distance_of(largest);
  geometry.nearest_distance = distance_of(largest + half);
  geometry.farthest_distance = distance_of(largest - half);
  std::array<glm::dvec3, 8> corners;
  for (int i = 0; i < 8; ++i) {
    corners[static_cast<std::size_t>(i)] = middle + half * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  }
  set_angle(geometry, glm::normalize(middle), corners);
  return geometry;
}

}  // namespace lkao::lut
