#include "scene/ground.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lut/coordinates.h"

namespace lkao::scene {
namespace {

// A box along axes of the ground's own: x and y in its plane, z up.
struct Frame {
  glm::dvec3 right, front, up;

  explicit Frame(const glm::dvec3& direction) : up(glm::normalize(direction)) {
    // The axis that is farthest from up; for an up along an axis the ground's sides lie along the others.
    const glm::dvec3 size = glm::abs(up);
    const glm::dvec3 axis = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                            : size.z <= size.y                   ? glm::dvec3(0, 0, 1)
                                                                 : glm::dvec3(0, 1, 0);
    front = glm::normalize(glm::cross(axis, up));
    right = glm::cross(front, up);
  }

  glm::dvec3 coordinates(const glm::dvec3& p) const {
    return {glm::dot(p, right), glm::dot(p, front), glm::dot(p, up)};
  }
  glm::dvec3 position(const glm::dvec3& c) const { return c.x * right + c.y * front + c.z * up; }
};

}  // namespace

Mesh make_ground(const Mesh& mesh, const glm::vec3& up, double radius) {
  const Bounds box = bounds_of(mesh);
  if (!lut::is_finite(up) || up == glm::vec3(0.0f)) throw std::invalid_argument("ground: up is zero or not finite");
  if (!(box.lower.x <= box.upper.x)) throw std::invalid_argument("ground: there is nothing to stand on it");

  const Frame frame{glm::dvec3(up)};
  glm::dvec3 lower(INFINITY), upper(-INFINITY);
  for (const glm::uvec3& triangle : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      const glm::vec3& p = mesh.positions[triangle[corner]];
      if (!lut::is_in_range(p)) continue;
      lower = glm::min(lower, frame.coordinates(glm::dvec3(p)));
      upper = glm::max(upper, frame.coordinates(glm::dvec3(p)));
    }
  }

  const double diagonal = glm::distance(glm::dvec3(box.lower), glm::dvec3(box.upper));
  const double reach = std::clamp(radius, diagonal, kGroundReach * diagonal);
  const double half_side = 0.5 * std::max(upper.x - lower.x, upper.y - lower.y) + reach;
  const glm::dvec3 middle(0.5 * (lower.x + upper.x), 0.5 * (lower.y + upper.y), lower.z - 1e-4 * diagonal);
  const auto corner = [&](double x, double y) {
    return glm::vec3(frame.position(middle + half_side * glm::dvec3(x, y, 0)));
  };
  Mesh ground;
  ground.positions = {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)};
  ground.triangles = {{0, 1, 2}, {0, 2, 3}};
  ground.origin = mesh.origin;
  return ground;
}

}  // namespace lkao::scene
