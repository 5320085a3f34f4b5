// Cheap tests for triangles that cannot block any ray of a receiver.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 5.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "bvh/query.h"

namespace lkao::bvh {

// The paper's four culls in its order. In float, each with a margin far above rounding: conservative.
inline bool is_culled(const glm::vec3& corner_a, const glm::vec3& corner_b, const glm::vec3& corner_c,
                      const Query& query) {
  constexpr float kMargin = 1e-4f;
  const glm::vec3 a = corner_a - query.rays.origin, b = corner_b - query.rays.origin, c = corner_c - query.rays.origin;
  const float size = std::max(glm::length(a), std::max(glm::length(b), glm::length(c)));

  // 1. All vertices are below the horizon.
  const float highest =
      std::max(glm::dot(query.rays.up, a), std::max(glm::dot(query.rays.up, b), glm::dot(query.rays.up, c)));
  if (highest < -kMargin * size) return true;

  // 2. The triangle is one-sided and faces away. 3. Its plane is farther than the radius.
  const glm::vec3 normal = glm::cross(b - a, c - a);
  const float distance = glm::dot(a, normal), length = glm::length(normal);
  const float rounding = kMargin * glm::length(b - a) * glm::length(c - a) * size;
  if (query.sidedness == Sidedness::one_sided && distance > rounding) return true;
  if (std::fabs(distance) > query.radius * length + rounding) return true;

  // 4. The receiver is outside the bounding sphere of the region of influence: the triangle's, the radius added.
  const glm::vec3 center = (glm::min(a, glm::min(b, c)) + glm::max(a, glm::max(b, c))) * 0.5f;
  const float radius = std::max(glm::distance(center, a), std::max(glm::distance(center, b), glm::distance(center, c)));
  return glm::length(center) > (radius + query.radius) + kMargin * size;
}

}  // namespace lkao::bvh
