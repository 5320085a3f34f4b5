// Which rays are blocked, exactly: every ray against every triangle, in arithmetic without rounding. Shares nothing
// with the library's own triangle test.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "lkao/ambient_occlusion.h"

namespace lkao::tests {

// How the segment (origin, origin + ray] meets a closed triangle.
enum class Crossing {
  none,
  touching,  // exactly in an edge or a corner, or with exactly the ray's end
  inside,
};

// One triangle as an origin sees it. All answers are signs of determinants of float coordinates. They are computed in
// double, with a bound on the rounding error, and where that leaves the sign open, with ExactSum: always exact.
//
// A triangle whose plane holds the origin is met by none: rays that leave its plane touch it at most with their open
// end, and a ray within the plane has distance 0 from an edge or lies inside, where either answer is right.
class SeenTriangle {
 public:
  SeenTriangle(const glm::vec3& corner_a, const glm::vec3& corner_b, const glm::vec3& corner_c,
               const glm::vec3& origin);

  // -1: the origin sees the front; +1: the back; 0: it lies in the plane.
  int side() const { return side_; }
  Crossing crossing(const glm::vec3& ray) const;

 private:
  int edge_sign(int edge, const glm::vec3& ray) const;
  int end_sign(const glm::vec3& ray) const;

  glm::vec3 corners_[3];
  glm::vec3 origin_;
  glm::dvec3 edges_[3];    // normals of the planes through the origin and an edge
  double edge_bounds_[3];  // of their rounding errors, for a ray of L1 norm 1
  glm::dvec3 normal_;      // of the triangle, not of unit length
  double distance_;        // of its plane, times the normal's length
  double distance_bound_;  // of its rounding error
  double normal_bound_;    // of the normal's, for a vector of L1 norm 1
  int side_;
};

// True where the corners lie on one line, without rounding.
bool has_exactly_zero_area(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

class Oracle {
 public:
  // The mesh must outlive the oracle. Triangles with a non-finite corner or exactly no area block nothing.
  Oracle(const TriangleMesh& mesh, Sidedness sidedness);

  // Of the rays that are cast.
  OcclusionMask blocked(const ReceiverRays& rays, std::uint32_t excluded_primitive = kNoPrimitive) const;

  // Triangles that ray `i` crosses, or -1 if it touches one, which leaves open whether it changes sides there.
  int crossing_count(const ReceiverRays& rays, int i) const;

  // Two measures for the rays that a method with rounding gets wrong, relative to the larger of the ray's length and
  // the distance of the triangle's farthest corner.
  //
  // A ray that is not blocked: how far it is from the triangle that it comes closest to, by an edge or by its own end.
  double distance_from_blocked(const ReceiverRays& rays, int i, std::uint32_t excluded_primitive) const;
  // A blocked ray: how far its origin is from the planes of the triangles that block it, the largest of them. In the
  // plane it would be met by none.
  double distance_from_plane(const ReceiverRays& rays, int i, std::uint32_t excluded_primitive) const;

  std::size_t zero_area_count() const { return zero_area_count_; }

 private:
  struct Candidate {
    std::uint32_t primitive;
    // A sphere around the triangle.
    glm::dvec3 center;
    double radius;
  };

  SeenTriangle seen(const Candidate& candidate, const glm::vec3& origin) const;
  // Calls visit(seen, primitive) for the triangles in reach that may block a ray from this origin.
  template <typename Visit>
  void for_each_in_reach(const glm::vec3& origin, double reach, std::uint32_t excluded, const Visit& visit) const;

  TriangleMesh mesh_;
  Sidedness sidedness_;
  std::vector<Candidate> candidates_;
  std::size_t zero_area_count_ = 0;
};

}  // namespace lkao::tests
