// Why a ray may come out differently in float: it passes an edge, or ends at a plane, within rounding.
#pragma once

#include <cmath>

#include <glm/geometric.hpp>

#include "lkao/ambient_occlusion.h"

namespace lkao::gl::tests {

// True where moving the ray by `share` of the distances in play (of the triangle's corners and the ray's end from the
// receiver) can decide whether the triangle blocks it: it is on the right side of all four planes or that close to
// them, and that close to one at least. The planes are those of bvh::TriangleTest, in double.
inline bool is_close_call(const glm::vec3& corner_a, const glm::vec3& corner_b, const glm::vec3& corner_c,
                          const glm::vec3& origin, const glm::vec3& ray, double share) {
  const glm::dvec3 o(origin), r(ray);
  const glm::dvec3 corners[3] = {glm::dvec3(corner_a) - o, glm::dvec3(corner_b) - o, glm::dvec3(corner_c) - o};
  const glm::dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  const double distance = glm::dot(normal, corners[0]), facing = distance < 0 ? -1.0 : 1.0;
  const double size = glm::length(corners[0]) + glm::length(corners[1]) + glm::length(corners[2]) + glm::length(r);
  const double beyond = facing * (glm::dot(r, normal) - distance);
  bool is_close = std::fabs(beyond) <= share * size || std::fabs(distance) <= share * size;
  if (beyond < -share * size) return false;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 &from = corners[i], &to = corners[(i + 1) % 3], along = to - from;
    const double side = facing * glm::dot(r, glm::cross(from, along));
    const double close = share * glm::length(r) * (glm::length(from) + glm::length(to)) * glm::length(along);
    if (side < -close) return false;
    is_close = is_close || side <= close;
  }
  return is_close;
}

}  // namespace lkao::gl::tests
