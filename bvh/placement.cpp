#include "bvh/placement.h"

#include <algorithm>
#include <cmath>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "bvh/bounds.h"
#include "bvh/box_margin.h"

namespace lkao::bvh {
namespace {

// The nearest float that is not nearer to zero, or next to it.
float rounded_up(double value) { return std::nextafter(static_cast<float>(value), kInfinity); }

double frobenius(const glm::dmat3& m) {
  return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

// What is as good as all corners: the boxes of the root's children are smaller than theirs together.
Bounds place_children(const glm::mat4x3& to_world, const Node& root) {
  Bounds box = kNowhere;
  for (int i = 0; i < kWidth && !root.children[i].is_empty(); ++i) {
    if (root.is_unreachable(i)) continue;
    box = merge(box, place(to_world, root.child_bounds(i)));
  }
  return box;
}

// A corner in the world is off by its rounding to float, and by that of the sums in double before.
glm::vec3 displacement_of(const Placement& placement, const Bounds& mesh_box) {
  const glm::dvec3 farthest = glm::max(glm::abs(glm::dvec3(mesh_box.lower)), glm::abs(glm::dvec3(mesh_box.upper)));
  glm::dvec3 rounding;
  for (int row = 0; row < 3; ++row) {
    double sum = std::fabs(double{placement.to_world[3][row]});
    for (int i = 0; i < 3; ++i) sum += std::fabs(double{placement.to_world[i][row]}) * farthest[i];
    const double largest = std::max(std::fabs(double{placement.box.lower[row]}),  //
                                    std::fabs(double{placement.box.upper[row]}));
    rounding[row] = 1.01 * 0x1p-24 * largest + 0x1p-149 + 0x1p-49 * sum;
  }
  glm::vec3 displacement;
  for (int axis = 0; axis < 3; ++axis) {
    double sum = 0;
    for (int row = 0; row < 3; ++row) sum += std::fabs(placement.to_mesh[row][axis]) * rounding[row];
    displacement[axis] = rounded_up(sum);
  }
  return displacement;
}

}  // namespace

Bounds place(const glm::mat4x3& to_world, const Bounds& box) {
  Bounds placed;
  for (int row = 0; row < 3; ++row) {
    const double offset{to_world[3][row]};
    double lower = offset, upper = offset, size = std::fabs(offset);
    for (int axis = 0; axis < 3; ++axis) {
      const double scale{to_world[axis][row]};
      const double a = scale * double{box.lower[axis]}, b = scale * double{box.upper[axis]};
      lower += std::min(a, b);
      upper += std::max(a, b);
      size += std::max(std::fabs(a), std::fabs(b));
    }
    // A corner rounds like the faces, which then move out as those of all nodes do.
    placed.lower[row] = static_cast<float>(lower - 0x1p-50 * size);
    placed.upper[row] = static_cast<float>(upper + 0x1p-50 * size);
  }
  return with_margin(placed);
}

Placement make_placement(const Layout& mesh, std::uint32_t mesh_number, const glm::mat4x3& to_world,
                         std::uint32_t groups) {
  const glm::dmat3 linear(to_world[0], to_world[1], to_world[2]), inverse = glm::inverse(linear);
  Placement placement{};
  placement.to_world = to_world;
  placement.to_mesh = glm::dmat4x3(inverse[0], inverse[1], inverse[2], -(inverse * glm::dvec3(to_world[3])));
  placement.box = place_children(to_world, mesh.root());
  if (!is_nowhere(mesh.bounds)) placement.displacement = displacement_of(placement, mesh.bounds);
  const double stretch = frobenius(linear), shrink = frobenius(inverse);
  placement.shrink = std::nextafter(static_cast<float>(1 / stretch), 0.0f);
  placement.mesh = mesh_number;
  placement.groups = groups;
  placement.is_mirrored = glm::determinant(linear) < 0;
  // The inverse is precise to some 2^-52 times this, a component of a ray to as much again.
  constexpr double kFlattest = 0x1p13;
  placement.suits_floats = stretch * shrink < kFlattest && stretch > 1e-15 && shrink > 1e-15;
  return placement;
}

}  // namespace lkao::bvh
