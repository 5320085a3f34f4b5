// A triangle of a mesh on its own: its plane and its angles.
#pragma once

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "bvh/usable_triangle.h"
#include "lut/coordinates.h"
#include "scene/mesh.h"

namespace lkao::scene {

struct Facet {
  glm::vec3 a, b, c;

  Facet(const Mesh& mesh, const glm::uvec3& triangle)
      : a(mesh.positions[triangle.x]), b(mesh.positions[triangle.y]), c(mesh.positions[triangle.z]) {}

  // Of finite corners, and with a plane; what follows needs both.
  bool is_usable() const { return lut::is_in_range(a, b, c) && !bvh::has_zero_area(a, b, c); }

  glm::dvec3 area_vector() const { return bvh::area_vector(a, b, c); }
  glm::dvec3 normal() const { return glm::normalize(area_vector()); }
  double area() const { return 0.5 * glm::length(area_vector()); }

  const glm::vec3& corner(int i) const { return i == 0 ? a : i == 1 ? b : c; }

  // At corner i, in radians; well conditioned for needles, unlike the arc cosine.
  double angle(int i) const {
    const glm::dvec3 p(corner(i));
    const glm::dvec3 to_next = glm::dvec3(corner((i + 1) % 3)) - p, to_previous = glm::dvec3(corner((i + 2) % 3)) - p;
    return std::atan2(glm::length(glm::cross(to_next, to_previous)), glm::dot(to_next, to_previous));
  }
};

}  // namespace lkao::scene
