#include "bvh/leaf.h"

#include "bvh/cut_outs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <glm/geometric.hpp>

namespace lkao::bvh {
namespace {

// 0, 1 or 2: the corner opposite the longest edge.
int corner_opposite_longest_edge(const glm::dvec3 (&corners)[3]) {
  int best = 0;
  double longest2 = -1;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 edge = corners[(i + 2) % 3] - corners[(i + 1) % 3];
    const double length2 = glm::dot(edge, edge);
    if (length2 > longest2) longest2 = length2, best = i;
  }
  return best;
}

void store(float (&target)[3][kLeafWidth], int triangle, const glm::dvec3& v) {
  for (int axis = 0; axis < 3; ++axis) target[axis][triangle] = static_cast<float>(v[axis]);
}

double largest_component(const glm::dvec3& v) {
  return std::max(std::fabs(v.x), std::max(std::fabs(v.y), std::fabs(v.z)));
}

void set_triangle(Leaf& leaf, int triangle, const glm::dvec3 (&corners)[3], bool has_holes) {
  const int first = has_holes ? 0 : corner_opposite_longest_edge(corners);
  const glm::dvec3 vertex = corners[first];
  const glm::dvec3 b = corners[(first + 1) % 3] - vertex, c = corners[(first + 2) % 3] - vertex;
  const glm::dvec3 normal = glm::cross(b, c);
  const double area2 = glm::dot(normal, normal);
  const glm::dvec3 u_gradient = glm::cross(c, normal) / area2, v_gradient = glm::cross(normal, b) / area2;
  const double steepness = std::max(largest_component(u_gradient), largest_component(v_gradient));

  store(leaf.vertex, triangle, vertex);
  // Thinner than this, even double precision has lost the direction of the normal.
  const bool is_thin = !(area2 > 0x1p-52 * glm::dot(b, b) * glm::dot(c, c));
  const bool fits_float = steepness < 0.5 * static_cast<double>(std::numeric_limits<float>::max());
  const float sign = has_holes ? -1.0f : 1.0f;
  if (is_thin || !fits_float) {
    leaf.steepness[triangle] = sign * std::numeric_limits<float>::infinity();
    return;  // gradients and normal stay 0
  }
  store(leaf.u_gradient, triangle, u_gradient);
  store(leaf.v_gradient, triangle, v_gradient);
  store(leaf.back_normal, triangle, -normal / std::sqrt(area2));
  leaf.steepness[triangle] = sign * static_cast<float>(steepness);
}

}  // namespace

Leaf make_leaf(const PackedMesh& mesh, std::span<const std::uint32_t> primitives, const CutOuts& cut_outs,
               const HoleGrids* grids) {
  Leaf leaf{};
  for (int triangle = 0; triangle < kLeafWidth; ++triangle) {
    const auto place = static_cast<std::size_t>(triangle);
    const std::uint32_t primitive = primitives[place < primitives.size() ? place : 0];
    leaf.primitives[triangle] = primitive;
    set_triangle(leaf, triangle,
                 {glm::dvec3(mesh.corner(primitive, 0)), glm::dvec3(mesh.corner(primitive, 1)),
                  glm::dvec3(mesh.corner(primitive, 2))},
                 has_holes(cut_outs, grids, primitive));
  }
  return leaf;
}

}  // namespace lkao::bvh
