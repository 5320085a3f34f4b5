// The error of a plane mask table by itself: random planes and triangles, looked up and computed; nothing of scenes.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "bvh/ray_triangle.h"
#include "lkao/occlusion_mask.h"
#include "lkao/plane_mask_table.h"

namespace lkao::bench {

// Rays a plane or triangle, on average.
struct RayErrors {
  double wrong = 0;     // on the wrong side of what the table says; none with must/may
  double in_doubt = 0;  // between must and may; none with nearest cells
};

struct PlaneErrors {
  RayErrors edge;      // planes through the receiver, normals evenly over the sphere
  RayErrors plane;     // distances evenly in [0, 1] as well
  RayErrors triangle;  // three edges and the plane, as the kernel combines them
};

// Planes and triangles with their exact masks for one pattern. Same arguments, same samples.
class PlaneSamples {
 public:
  PlaneSamples(SamplePattern pattern, int count, std::uint64_t seed);

  // The table's pattern must be that of the samples.
  PlaneErrors errors(const PlaneMaskTable& table) const;

 private:
  struct Plane {
    glm::dvec3 normal;
    double distance;
    OcclusionMask beyond;
  };
  struct Triangle {
    bvh::TriangleTest test;
    OcclusionMask blocked;
  };
  void add_plane(std::vector<Plane>& planes, const glm::dvec3& normal, double distance) const;
  void add_triangle(const glm::vec3& center, float size, const glm::vec3 (&offsets)[3]);

  SamplePattern pattern_;
  std::vector<glm::vec3> ends_;
  std::vector<Plane> edges_, planes_;
  std::vector<Triangle> triangles_;
};

}  // namespace lkao::bench
