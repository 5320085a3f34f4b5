// Planes for the tests of the plane mask table.
#pragma once

#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "lkao/sample_pattern.h"
#include "support/meshes.h"

namespace lkao::tests {

// A plane as the table is asked about it.
struct Plane {
  glm::vec3 normal;
  float distance = 0;
};

// Where the rays end.
inline std::vector<glm::dvec3> ends_of(const SamplePattern& pattern) {
  std::vector<glm::dvec3> ends;
  for (std::size_t i = 0; i < pattern.directions().size(); ++i) {
    ends.emplace_back(pattern.directions()[i] * pattern.lengths()[i]);
  }
  return ends;
}

inline double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// Turned by `angle` towards a random side.
inline glm::dvec3 turned(const glm::dvec3& normal, double angle, lut::RandomStream& random) {
  const glm::dvec3 side = glm::normalize(glm::cross(normal, glm::dvec3(random_direction(random))));
  return std::cos(angle) * glm::normalize(normal) + std::sin(angle) * side;
}

}  // namespace lkao::tests
