// From planes to cells of the plane mask table, and back.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 3.1.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lkao/plane_addressing.h"

namespace lkao::lut {

// All planes that one cell stands for: normals within an angle of `axis`, distances from `nearest_distance` to
// `farthest_distance`.
struct PlaneCell {
  bool is_used = false;  // false where no plane has this cell
  glm::vec3 axis{0};     // of the plane in the middle, a unit vector
  float distance = 0;    // of the plane in the middle
  float angle_cos = 1;
  float angle_sin = 0;
  float nearest_distance = 0;
  float farthest_distance = 0;
};

// Sec. 3.1: "we take d_norm = 1 - 7/8 (d/r)".
inline constexpr float kDistanceShare = 7.0f / 8.0f;

// Cell of a coordinate in [-1, 1] on a grid whose outermost cells have their middle at -1 and 1.
inline std::uint32_t grid_place(float coordinate, int resolution) {
  const float place = (coordinate * 0.5f + 0.5f) * static_cast<float>(resolution - 1);
  return static_cast<std::uint32_t>(std::clamp(place + 0.5f, 0.0f, static_cast<float>(resolution) - 0.5f));
}

// The paper's address: the outermost layer of the cube holds d = 0, as a cube map.
inline std::uint32_t cube_cell(const glm::vec3& n, float d, int resolution) {
  const float largest = std::max(std::fabs(n.x), std::max(std::fabs(n.y), std::fabs(n.z)));
  const float scale = (1.0f - kDistanceShare * std::clamp(d, 0.0f, 1.0f)) / largest;
  const std::uint32_t x = grid_place(n.x * scale, resolution), y = grid_place(n.y * scale, resolution),
                      z = grid_place(n.z * scale, resolution);
  const auto side = static_cast<std::uint32_t>(resolution);
  return (z * side + y) * side + x;
}

// Cube maps of the normal have 6 faces of side x side cells. On a face, x in [-1, 1] is warped to w in [-1, 1], so that
// cells are of nearly one size on the sphere: as good as equal angles, w = 4/pi atan x, and without a tangent.
inline constexpr float kCubeMapWarp = 0.4f;
inline float warp(float x) { return (1.0f + kCubeMapWarp) * x / (1.0f + kCubeMapWarp * std::fabs(x)); }
inline double unwarp(double w) { return w / (1.0 + kCubeMapWarp - kCubeMapWarp * std::fabs(w)); }

// Cell of a direction in such a map. Faces: +x, -x, +y, -y, +z, -z.
inline std::uint32_t cube_map_cell(const glm::vec3& n, std::uint32_t side) {
  const glm::vec3 size = glm::abs(n);
  float along = n.x, u = n.y, v = n.z;
  std::uint32_t face = 0;
  if (size.y > size.x && size.y >= size.z) {
    along = n.y, u = n.z, v = n.x, face = 2;
  } else if (size.z > size.x) {
    along = n.z, u = n.x, v = n.y, face = 4;
  }
  if (along < 0) ++face;
  const float scale = 1.0f / std::fabs(along), half = 0.5f * static_cast<float>(side);
  const auto x = std::min(static_cast<std::uint32_t>((warp(u * scale) + 1.0f) * half), side - 1);
  const auto y = std::min(static_cast<std::uint32_t>((warp(v * scale) + 1.0f) * half), side - 1);
  return (face * side + y) * side + x;
}

// Where among the slices, from 0 to 1, the planes at distance d are. Slices are thinner towards d = 1, where the cones
// around small and far nodes end up (lut/README.md).
inline float slice_place(float d) {
  const float root = std::sqrt(1.0f - std::clamp(d, 0.0f, 1.0f));
  return 1.0f - 0.5f * (root + root * root);
}

// The sizes of a table's maps, and the addresses that follow from them. One definition for every use.
class PlaneCells {
 public:
  PlaneCells(PlaneAddressing addressing, int resolution);

  std::uint32_t cell(const glm::vec3& n, float d) const {
    if (addressing_ == PlaneAddressing::cube) return cube_cell(n, d, resolution_);
    const float place = slice_place(d) * static_cast<float>(slice_count_);
    const std::uint32_t slice = std::min(static_cast<std::uint32_t>(place), slice_count_ - 1);
    return edge_cell_count_ + slice * slice_cell_count_ + cube_map_cell(n, slice_side_);
  }
  std::uint32_t edge_cell(const glm::vec3& n) const {
    return addressing_ == PlaneAddressing::cube ? cube_cell(n, 0, resolution_) : cube_map_cell(n, edge_side_);
  }

  std::uint32_t cell_count() const { return cell_count_; }
  // With PlaneAddressing::slices: cells along a side of the map of edges and of the map of each slice, and the number
  // of slices; the maps lie one behind the other, that of edges first. 0 with PlaneAddressing::cube.
  std::uint32_t edge_side() const { return edge_side_; }
  std::uint32_t slice_side() const { return slice_side_; }
  std::uint32_t slice_count() const { return slice_count_; }
  // The planes of a cell.
  PlaneCell geometry(std::uint32_t cell) const;

 private:
  PlaneCell cube_geometry(std::uint32_t cell) const;

  PlaneAddressing addressing_;
  int resolution_;
  std::uint32_t edge_side_ = 0;   // cells along the side of the map of edges
  std::uint32_t slice_side_ = 0;  // ... of the map of each slice
  std::uint32_t slice_count_ = 0;
  std::uint32_t edge_cell_count_ = 0;
  std::uint32_t slice_cell_count_ = 0;
  std::uint32_t cell_count_ = 0;
};

}  // namespace lkao::lut
