// Ambient occlusion volumes against rays of linear falloff: errors, fill, and the curve that makes up for occluders
// that are counted twice.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "bench/drawn_method.h"

namespace lkao::bench {

struct VolumesResult : DrawnResult {
  double fill = 0, inside = 0, blended = 0;  // fragments a receiver (gl::VolumeFragments)
  double log_error = 0;                      // Eq. 14
};
VolumesResult draw_volumes(const StudyScene& scene, float radius, const method::Settings& settings,
                           const std::vector<float>& rays);

// McGuire 2010, Eq. 14: of accessibility in steps of 8 bits, the mean squared error of its logarithm and half of those
// of its differences along x and y; over pixels, and neighbours, where both pictures have receivers.
double log_error(const std::vector<float>& occlusion, const std::vector<float>& right, int width, int height);

// The polynomial x o + y o^2 + z o^3 of drawn occlusion that comes nearest to the rays, in the sense of least squares;
// every picture counts the same.
class CompensationFit {
 public:
  void add(const std::vector<float>& occlusion, const std::vector<float>& right);
  glm::dvec3 curve() const;

 private:
  double products_[3][3] = {};
  double right_[3] = {};
};

}  // namespace lkao::bench
