// Does a ray meet a triangle? The definition that every kernel agrees with bit for bit.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 3.1 and Figure 1:
// three planes through the receiver and the triangle's edges, and the triangle's own plane.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lkao/receiver.h"

namespace lkao::bvh {

// The four planes of one triangle as one receiver sees them, and how far rounding may have moved them.
//
// Everything is in double, from float coordinates: differences of coordinates are then exact unless one is 2^29 times
// the other. Cross products carry the residues of their products along, so that they are precise for slivers too, and
// each of the dot products below is within kRounding of the product of the L1 norms of its factors. A ray within that
// of a plane counts as beyond it, so triangles that share an edge leave no gap between them, not even at their corners
// or where a zero-area triangle between them was dropped; the surplus is some 1e-15 wide, whatever the triangle's
// shape.
//
// Edge planes come from (a + b) x (b - a) = 2 (a x b), which keeps its precision for small triangles far away, and
// which changes nothing but its sign when a and b change places.
class TriangleTest {
 public:
  // Corners as in the mesh; rays start at `origin` and are no longer than `radius`.
  TriangleTest(const glm::vec3& corner_a, const glm::vec3& corner_b, const glm::vec3& corner_c, const glm::vec3& origin,
               float radius, Sidedness sidedness) {
    const glm::dvec3 a = glm::dvec3(corner_a) - glm::dvec3(origin);
    const glm::dvec3 b = glm::dvec3(corner_b) - glm::dvec3(origin);
    const glm::dvec3 c = glm::dvec3(corner_c) - glm::dvec3(origin);
    normal_ = precise_cross(b - a, c - a);
    const double size = norm(normal_) + 0x1p-52 * norm(b - a) * norm(c - a);
    // The plane is at `distance_` times the normal, which may point either way.
    distance_ = glm::dot(a, normal_);
    // In front means on the side that the normal points to: there the origin sees a negative distance.
    in_front_ = distance_ < 0;
    const bool in_plane = std::fabs(distance_) <= kRounding * size * norm(a);
    const bool too_far =
        std::fabs(distance_) > 1.001 * static_cast<double>(radius) * std::sqrt(glm::dot(normal_, normal_));
    can_block_ = !in_plane && !too_far && (in_front_ || sidedness == Sidedness::two_sided);
    if (!can_block_) return;
    // From here on planes face away from the origin: rays that pass the triangle are beyond all four.
    const double facing = in_front_ ? -1.0 : 1.0;
    normal_ *= facing;
    distance_ *= facing;
    ray_norm_ = 1.7321 * static_cast<double>(radius);
    normal_rounding_ = kRounding * size;
    position_norm_ = norm(a);
    set_edge(0, a, b, facing);
    set_edge(1, b, c, facing);
    set_edge(2, c, a, facing);
  }

  // False where no ray at all can be blocked: one-sided and seen from behind, farther than the radius, or the origin
  // lies in the triangle's plane (to rounding), where it would only be met at the ray's open end.
  bool can_block() const { return can_block_; }

  // True where the origin lies on the side that the triangle faces. Requires can_block().
  bool in_front() const { return in_front_; }

  // True where the segment (0, ray], relative to the origin, meets the triangle; there is none where the ray is 0.
  // Requires can_block().
  bool blocks(const glm::vec3& ray) const {
    const glm::dvec3 r(ray);
    return ray != glm::vec3(0) && glm::dot(r, edges_[0]) >= -edge_slacks_[0] &&
           glm::dot(r, edges_[1]) >= -edge_slacks_[1] && glm::dot(r, edges_[2]) >= -edge_slacks_[2] &&
           glm::dot(r, normal_) >= distance_ - normal_slack(1);
  }

  // The same for a part of the segment: from `begin` times the ray to `end` times the ray, 0 <= begin <= end <= 1.
  // A triangle that blocks the ray blocks at least one of the parts that it is divided into.
  bool blocks(const glm::vec3& ray, double begin, double end) const {
    const double towards = glm::dot(glm::dvec3(ray), normal_);
    return blocks(ray) && towards * end >= distance_ - normal_slack(end) &&
           towards * begin <= distance_ + normal_slack(begin);
  }

  // Where the ray's line meets the plane, in weights of the second and the third corner. Requires blocks(ray).
  glm::dvec2 place(const glm::vec3& ray) const {
    const glm::dvec3 r(ray);
    const double of_a = std::max(glm::dot(r, edges_[1]), 0.0), of_b = std::max(glm::dot(r, edges_[2]), 0.0),
                 of_c = std::max(glm::dot(r, edges_[0]), 0.0), sum = of_a + of_b + of_c;
    return sum > 0 ? glm::dvec2(of_b, of_c) / sum : glm::dvec2(0);
  }

  // The planes, for kernels that decide by other means first. Normals are not of unit length; rays beyond all of
  // edge(i) . x = 0 and normal() . x = distance() are blocked. Require can_block().
  const glm::dvec3& edge(int i) const { return edges_[i]; }
  const glm::dvec3& normal() const { return normal_; }
  double distance() const { return distance_; }
  // True where rounding has moved the normal by less than 1e-6 radians: not where the origin is as good as on the
  // edge's line, or the triangle as good as a line.
  bool has_edge_direction(int i) const { return is_sure(edges_[i], edge_slacks_[i]); }
  bool has_normal_direction() const { return is_sure(normal_, normal_slack(1)); }
  // The same for planes in units of a distance less than the radius, of which rounding is a larger share.
  bool has_normal_direction_at(float distance) const {
    return norm(normal_) * 1.7321 * static_cast<double>(distance) > 1e6 * normal_slack(1);
  }

 private:
  // `slack` is the error of the vector times the length of a ray.
  bool is_sure(const glm::dvec3& vector, double slack) const { return norm(vector) * ray_norm_ > 1e6 * slack; }

  // The error of that share of a ray times the normal, and of the distance: of what is near, it is that of what is
  // near, however long the ray.
  double normal_slack(double share) const { return normal_rounding_ * (position_norm_ + share * ray_norm_); }

  static constexpr double kRounding = 0x1p-49;

  static double norm(const glm::dvec3& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

  // a b - c d. Exchanging the products changes its sign and nothing else.
  static double precise_difference(double a, double b, double c, double d) {
    const double first = a * b, second = c * d;
    return (first - second) + (std::fma(a, b, -first) - std::fma(c, d, -second));
  }
  static glm::dvec3 precise_cross(const glm::dvec3& a, const glm::dvec3& b) {
    return {precise_difference(a.y, b.z, a.z, b.y), precise_difference(a.z, b.x, a.x, b.z),
            precise_difference(a.x, b.y, a.y, b.x)};
  }

  void set_edge(int edge, const glm::dvec3& from, const glm::dvec3& to, double facing) {
    const glm::dvec3 sum = from + to, along = to - from;
    edges_[edge] = facing * precise_cross(sum, along);
    edge_slacks_[edge] = kRounding * (norm(edges_[edge]) + 0x1p-52 * norm(sum) * norm(along)) * ray_norm_;
  }

  double ray_norm_;  // L1 norm of the longest ray
  glm::dvec3 edges_[3];
  double edge_slacks_[3];
  glm::dvec3 normal_;
  double distance_;
  double normal_rounding_, position_norm_;
  bool can_block_;
  bool in_front_;
};

}  // namespace lkao::bvh
