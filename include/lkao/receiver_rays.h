// The rays of one receiver.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "lkao/occlusion_mask.h"
#include "lkao/requirements.h"
#include "lkao/sample_pattern.h"

namespace lkao {

// The rays that a receiver casts, in world space: segments from `origin` to `origin + ray(i)`.
struct ReceiverRays {
  glm::vec3 origin{0};
  // A rotation: where the pattern's axes go; the last column is near the normal. The direction of ray i is
  // frame x pattern().directions()[i].
  glm::mat3 frame{1};
  // Unit vector, the geometric normal: no cast ray goes below its horizon.
  glm::vec3 up{0, 0, 1};
  // The AO radius. Where that is infinite, a power of two that no occluder is farther away than from this origin: with
  // rays of that length instead, nothing changes.
  float radius = 0;
  // Rays above the geometric horizon; the others are not cast. Empty for an invalid receiver.
  OcclusionMask cast;
  int ray_count = 0;
  // Direction x length of each ray, component by component. Rays without length, which are not cast, follow up to a
  // whole word of the mask.
  alignas(64) float x[kMaxRayCount];
  alignas(64) float y[kMaxRayCount];
  alignas(64) float z[kMaxRayCount];

  int word_count() const { return word_count_of(ray_count); }
  glm::vec3 ray(int i) const { return {x[i], y[i], z[i]}; }
};

}  // namespace lkao
