// Where the chunks of a sample pattern point: one cone for each 16 neighbouring rays.
#pragma once

#include <span>

#include <glm/vec3.hpp>

#include "lkao/occlusion_mask.h"

namespace lkao::bvh {

// Cones in the pattern's space, component by component. The directions of chunk i make an angle with the unit vector
// (x, y, z)[i] whose cosine is no less than cosine[i], and whose sine is no more than sine[i]. Chunks behind the last
// have the last one's cone.
struct PatternCones {
  static constexpr int kRaysPerCone = 16;
  static constexpr int kMaxCount = kMaxRayCount / kRaysPerCone;

  alignas(64) float x[kMaxCount] = {}, y[kMaxCount] = {}, z[kMaxCount] = {};
  alignas(64) float cosine[kMaxCount] = {}, sine[kMaxCount] = {};
  // Of an angle that no direction of the pattern exceeds to the z axis: the cosine no more, the sine no less. Not
  // known of bundles.
  float widest_cosine = -1, widest_sine = 1;
  // A narrow bundle (bundle_shape.h): no component of its rays, in world space, is less or more than this.
  bool is_bundle = false;
  glm::vec3 least{0}, most{0};
  // With fewer rays the cones tell too little to be asked. The intervals above tell most of it: a narrow bundle of so
  // few has none.
  bool are_of_use(int ray_count) const { return ray_count >= (is_bundle ? 1024 : 256); }
};

// Of unit vectors, one at least; the last cone is of those that are left.
PatternCones make_pattern_cones(std::span<const glm::vec3> directions);

}  // namespace lkao::bvh
