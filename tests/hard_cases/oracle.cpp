#include "oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "distance.h"
#include "exact_sum.h"

namespace lkao::tests {
namespace {

// More than the relative rounding errors that add up in a determinant of three vectors, each a difference of floats:
// no term of it goes through more than ten operations.
constexpr double kRounding = 16 * 0x1p-53;

double norm(const glm::dvec3& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

bool is_finite_corner(const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

int sign_of(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

// The sign of a number known to within `bound`; where that leaves it open, of what `exact` computes.
template <typename Exact>
int sign_of(double value, double bound, const Exact& exact) {
  return std::fabs(value) > bound ? sign_of(value) : exact().sign();
}

ExactVec exact_difference(const glm::vec3& a, const glm::vec3& b) { return ExactVec(a) - ExactVec(b); }

ExactVec exact_normal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return cross(exact_difference(b, a), exact_difference(c, a));
}

RealTriangle relative_triangle(const TriangleMesh& mesh, std::uint32_t primitive, const glm::vec3& origin) {
  RealTriangle triangle;
  for (int i = 0; i < 3; ++i) {
    triangle[static_cast<std::size_t>(i)] = RealVec(mesh.positions[mesh.triangles[primitive][i]]) - RealVec(origin);
  }
  return triangle;
}

Real size_of(const RealTriangle& triangle, const RealVec& ray) {
  return std::max({glm::length(ray), glm::length(triangle[0]), glm::length(triangle[1]), glm::length(triangle[2])});
}

}  // namespace

SeenTriangle::SeenTriangle(const glm::vec3& corner_a, const glm::vec3& corner_b, const glm::vec3& corner_c,
                           const glm::vec3& origin)
    : corners_{corner_a, corner_b, corner_c}, origin_(origin) {
  const glm::dvec3 o(origin), corners[3] = {glm::dvec3(corner_a), glm::dvec3(corner_b), glm::dvec3(corner_c)};
  const glm::dvec3 along_b = corners[1] - corners[0], along_c = corners[2] - corners[0];
  const glm::dvec3 relative[3] = {corners[0] - o, corners[1] - o, corners[2] - o};
  normal_ = glm::cross(along_b, along_c);
  normal_bound_ = kRounding * norm(along_b) * norm(along_c);
  distance_ = glm::dot(relative[0], normal_);
  distance_bound_ = normal_bound_ * norm(relative[0]);
  side_ = sign_of(distance_, distance_bound_,
                  [&] { return dot(exact_difference(corner_a, origin), exact_normal(corner_a, corner_b, corner_c)); });
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 &from = relative[i], &to = relative[(i + 1) % 3];
    edges_[i] = glm::cross(from, to);
    edge_bounds_[i] = kRounding * norm(from) * norm(to);
  }
}

int SeenTriangle::edge_sign(int edge, const glm::vec3& ray) const {
  const glm::dvec3 r(ray);
  return sign_of(glm::dot(r, edges_[edge]), edge_bounds_[edge] * norm(r), [&] {
    const ExactVec from = exact_difference(corners_[edge], origin_);
    const ExactVec to = exact_difference(corners_[(edge + 1) % 3], origin_);
    return dot(ExactVec(ray), cross(from, to));
  });
}

// Of (ray - a) . normal: positive where the ray's end is on the side that the normal points to.
int SeenTriangle::end_sign(const glm::vec3& ray) const {
  const glm::dvec3 r(ray);
  const double bound = 2 * (normal_bound_ * norm(r) + distance_bound_);
  return sign_of(glm::dot(r, normal_) - distance_, bound, [&] {
    return dot(ExactVec(ray) - exact_difference(corners_[0], origin_),
               exact_normal(corners_[0], corners_[1], corners_[2]));
  });
}

Crossing SeenTriangle::crossing(const glm::vec3& ray) const {
  if (side_ == 0) return Crossing::none;
  bool touching = false;
  for (int edge = 0; edge < 3; ++edge) {
    const int sign = edge_sign(edge, ray) * side_;
    if (sign < 0) return Crossing::none;
    touching |= sign == 0;
  }
  const int sign = end_sign(ray) * side_;
  if (sign < 0) return Crossing::none;
  return touching || sign == 0 ? Crossing::touching : Crossing::inside;
}

bool has_exactly_zero_area(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::dvec3 along_b = glm::dvec3(b) - glm::dvec3(a), along_c = glm::dvec3(c) - glm::dvec3(a);
  if (norm(glm::cross(along_b, along_c)) > 3 * kRounding * norm(along_b) * norm(along_c)) return false;
  const ExactVec normal = exact_normal(a, b, c);
  return normal.x.sign() == 0 && normal.y.sign() == 0 && normal.z.sign() == 0;
}

Oracle::Oracle(const TriangleMesh& mesh, Sidedness sidedness) : mesh_(mesh), sidedness_(sidedness) {
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3 t = mesh.triangles[i];
    const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    if (!is_finite_corner(a) || !is_finite_corner(b) || !is_finite_corner(c)) continue;
    if (has_exactly_zero_area(a, b, c)) {
      ++zero_area_count_;
      continue;
    }
    const glm::dvec3 center = (glm::dvec3(a) + glm::dvec3(b) + glm::dvec3(c)) / 3.0;
    const double radius = std::max({glm::length(glm::dvec3(a) - center), glm::length(glm::dvec3(b) - center),
                                    glm::length(glm::dvec3(c) - center)});
    // Rounding of the centre and of distances from it, generously.
    candidates_.push_back({i, center, radius + 1e-14 * (radius + norm(center))});
  }
}

SeenTriangle Oracle::seen(const Candidate& candidate, const glm::vec3& origin) const {
  const glm::uvec3 t = mesh_.triangles[candidate.primitive];
  return SeenTriangle(mesh_.positions[t.x], mesh_.positions[t.y], mesh_.positions[t.z], origin);
}

template <typename Visit>
void Oracle::for_each_in_reach(const glm::vec3& origin, double reach, std::uint32_t excluded,
                               const Visit& visit) const {
  for (const Candidate& candidate : candidates_) {
    if (candidate.primitive == excluded) continue;
    const double limit = candidate.radius + reach, away = glm::distance(candidate.center, glm::dvec3(origin));
    if (away * (1 - 1e-14) > limit * (1 + 1e-14)) continue;
    const SeenTriangle triangle = seen(candidate, origin);
    if (sidedness_ == Sidedness::one_sided && triangle.side() > 0) continue;
    visit(triangle, candidate.primitive);
  }
}

OcclusionMask Oracle::blocked(const ReceiverRays& rays, std::uint32_t excluded_primitive) const {
  double reach = 0;
  std::vector<int> open;
  for (int i = 0; i < rays.ray_count; ++i) {
    if (!rays.cast.test(i)) continue;
    open.push_back(i);
    reach = std::max(reach, glm::length(glm::dvec3(rays.ray(i))));
  }
  OcclusionMask mask;
  for_each_in_reach(rays.origin, reach, excluded_primitive, [&](const SeenTriangle& triangle, std::uint32_t) {
    if (triangle.side() == 0) return;
    std::erase_if(open, [&](int i) {
      if (triangle.crossing(rays.ray(i)) == Crossing::none) return false;
      mask.set(i);
      return true;
    });
  });
  return mask;
}

int Oracle::crossing_count(const ReceiverRays& rays, int i) const {
  const glm::dvec3 origin(rays.origin), direction = glm::normalize(glm::dvec3(rays.ray(i)));
  int count = 0;
  bool touching = false;
  for (const Candidate& candidate : candidates_) {
    // The sphere around the triangle against the line of the ray.
    const glm::dvec3 to_center = candidate.center - origin;
    const double limit = candidate.radius + 1e-13 * norm(to_center);
    const glm::dvec3 across = glm::cross(to_center, direction);
    if (glm::dot(across, across) > limit * limit) continue;
    const SeenTriangle triangle = seen(candidate, rays.origin);
    const Crossing crossing = triangle.crossing(rays.ray(i));
    count += crossing == Crossing::inside;
    // With the origin in the plane of a triangle nothing can be said either: it may lie on it.
    touching |= crossing == Crossing::touching || triangle.side() == 0;
  }
  return touching ? -1 : count;
}

double Oracle::distance_from_blocked(const ReceiverRays& rays, int i, std::uint32_t excluded_primitive) const {
  Real nearest = std::numeric_limits<Real>::infinity();
  const RealVec ray(rays.ray(i));
  // A little further than the ray, which may end just before its triangle.
  const double reach = 1.01 * static_cast<double>(glm::length(ray));
  for_each_in_reach(rays.origin, reach, excluded_primitive, [&](const SeenTriangle&, std::uint32_t primitive) {
    const RealTriangle triangle = relative_triangle(mesh_, primitive, rays.origin);
    const Real distance = std::min(edge_distance(RealVec(0), ray, triangle), point_triangle_distance(ray, triangle));
    nearest = std::min(nearest, distance / size_of(triangle, ray));
  });
  return static_cast<double>(nearest);
}

double Oracle::distance_from_plane(const ReceiverRays& rays, int i, std::uint32_t excluded_primitive) const {
  Real farthest = 0;
  const glm::vec3 ray = rays.ray(i);
  const double reach = glm::length(glm::dvec3(ray));
  for_each_in_reach(rays.origin, reach, excluded_primitive, [&](const SeenTriangle& seen, std::uint32_t primitive) {
    if (seen.crossing(ray) == Crossing::none) return;
    const RealTriangle triangle = relative_triangle(mesh_, primitive, rays.origin);
    farthest = std::max(farthest, plane_distance(RealVec(0), triangle) / size_of(triangle, RealVec(ray)));
  });
  return static_cast<double>(farthest);
}

}  // namespace lkao::tests
