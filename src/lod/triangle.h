// A triangle in double precision, and how far it is from a point.
#pragma once

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace lkao::lod {

struct Triangle {
  glm::dvec3 a, b, c;
};

inline double area_of(const Triangle& t) { return 0.5 * glm::length(glm::cross(t.b - t.a, t.c - t.a)); }

inline double longest_side(const Triangle& t) {
  return std::max({glm::distance(t.a, t.b), glm::distance(t.b, t.c), glm::distance(t.c, t.a)});
}

// The corners in turn so that the side from a to b is the longest.
inline Triangle longest_side_first(const Triangle& t) {
  const double ab = glm::distance(t.a, t.b), bc = glm::distance(t.b, t.c), ca = glm::distance(t.c, t.a);
  if (bc >= ab && bc >= ca) return {t.b, t.c, t.a};
  if (ca >= ab && ca >= bc) return {t.c, t.a, t.b};
  return t;
}

// No point of a triangle is farther from the nearest corner than this share of the longest side (1 / sqrt(3)).
inline constexpr double kFarthestFromCorners = 0.5774;

inline double squared_distance_to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double squared_length = glm::dot(along, along);
  const double t = squared_length > 0 ? glm::clamp(glm::dot(p - a, along) / squared_length, 0.0, 1.0) : 0.0;
  const glm::dvec3 off = p - (a + t * along);
  return glm::dot(off, off);
}

// The nearest point lies inside, where the plane is nearest, or on a side.
inline double squared_distance(const glm::dvec3& p, const Triangle& t) {
  const glm::dvec3 normal = glm::cross(t.b - t.a, t.c - t.a);
  const double squared_normal = glm::dot(normal, normal);
  const auto is_inside = [&](const glm::dvec3& from, const glm::dvec3& to) {
    return glm::dot(glm::cross(normal, to - from), p - from) >= 0;
  };
  if (squared_normal > 0 && is_inside(t.a, t.b) && is_inside(t.b, t.c) && is_inside(t.c, t.a)) {
    const double height = glm::dot(normal, p - t.a);
    return height * height / squared_normal;
  }
  return std::min({squared_distance_to_segment(p, t.a, t.b), squared_distance_to_segment(p, t.b, t.c),
                   squared_distance_to_segment(p, t.c, t.a)});
}

}  // namespace lkao::lod
