#include "scene/formats/gltf/transform.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace lkao::scene::gltf {

Transform::Transform(const glm::dmat4& matrix) : matrix_(matrix), is_identity_(matrix == glm::dmat4(1.0)) {
  const glm::dmat3 m(matrix);
  is_mirroring_ = glm::determinant(m) < 0;
  // The inverse transpose but for its length: it exists for flat matrices too.
  const double sign = is_mirroring_ ? -1.0 : 1.0;
  for_normals_ = sign * glm::dmat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
}

glm::dvec3 Transform::position(const glm::dvec3& p) const {
  // Untouched where there is nothing to do: 0 x infinity would turn an infinite coordinate into others' NaN.
  return is_identity_ ? p : glm::dvec3(matrix_ * glm::dvec4(p, 1.0));
}

glm::vec3 Transform::normal(const glm::dvec3& n) const {
  const glm::dvec3 turned = for_normals_ * n;
  const double length = glm::length(turned);
  return length > 0 && std::isfinite(length) ? glm::vec3(turned / length) : glm::vec3(0.0f);
}

}  // namespace lkao::scene::gltf
