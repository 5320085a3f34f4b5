// Distances between segments and triangles in long double. Each is the distance between two points that are found on
// them, so rounding makes it too large rather than too small.
#pragma once

#include <algorithm>
#include <array>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace lkao::tests {

using Real = long double;
using RealVec = glm::vec<3, Real>;
using RealTriangle = std::array<RealVec, 3>;

// From the point p to the segment from a to b.
inline Real point_segment_distance(const RealVec& p, const RealVec& a, const RealVec& b) {
  const RealVec along = b - a;
  const Real square = glm::dot(along, along);
  const Real share = square > 0 ? std::clamp(glm::dot(p - a, along) / square, Real(0), Real(1)) : Real(0);
  return glm::length(p - (a + share * along));
}

// From the segment from p to q to the segment from a to b.
inline Real segment_distance(const RealVec& p, const RealVec& q, const RealVec& a, const RealVec& b) {
  Real nearest = std::min({point_segment_distance(p, a, b), point_segment_distance(q, a, b),
                           point_segment_distance(a, p, q), point_segment_distance(b, p, q)});
  const RealVec u = q - p, v = b - a, normal = glm::cross(u, v);
  const Real square = glm::dot(normal, normal);
  if (square == 0) return nearest;
  // Where the lines come closest.
  const Real s = std::clamp(glm::dot(glm::cross(a - p, v), normal) / square, Real(0), Real(1));
  const Real t = std::clamp(glm::dot(glm::cross(a - p, u), normal) / square, Real(0), Real(1));
  return std::min(nearest, glm::length((p + s * u) - (a + t * v)));
}

// From the segment from p to q to the nearest edge of the triangle.
inline Real edge_distance(const RealVec& p, const RealVec& q, const RealTriangle& triangle) {
  return std::min({segment_distance(p, q, triangle[0], triangle[1]), segment_distance(p, q, triangle[1], triangle[2]),
                   segment_distance(p, q, triangle[2], triangle[0])});
}

// From the point p to the plane of the triangle, which must have one.
inline Real plane_distance(const RealVec& p, const RealTriangle& triangle) {
  const RealVec normal = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
  return glm::abs(glm::dot(p - triangle[0], normal)) / glm::length(normal);
}

// From the point p to the triangle.
inline Real point_triangle_distance(const RealVec& p, const RealTriangle& triangle) {
  const auto& [a, b, c] = triangle;
  const RealVec normal = glm::cross(b - a, c - a);
  const bool over_it = glm::dot(glm::cross(b - a, p - a), normal) >= 0 &&
                       glm::dot(glm::cross(c - b, p - b), normal) >= 0 &&
                       glm::dot(glm::cross(a - c, p - c), normal) >= 0;
  if (over_it && normal != RealVec(0)) return plane_distance(p, triangle);
  return std::min({point_segment_distance(p, a, b), point_segment_distance(p, b, c), point_segment_distance(p, c, a)});
}

}  // namespace lkao::tests
