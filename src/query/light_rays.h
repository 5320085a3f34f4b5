// From a receiver to rays that end at points of a light.
#pragma once

#include <cstdint>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "lkao/area_light.h"
#include "lkao/receiver_rays.h"
#include "query/receiver_rays.h"

namespace lkao::query {

// A light from one origin.
struct SeenLight {
  // A rotation: of a disc, its normal in the last column; of a sphere, the direction of its centre.
  glm::mat3 frame{1};
  glm::vec3 center{0};  // relative to the origin
  float radius = 0;
  // Of a sphere: 1 less the cosine of the cone in which it is seen, 2 from within; its distance, and radius / distance
  // squared.
  float one_minus_cosine = 0, distance = 0, sine2 = 0;
  bool is_within = false, is_sphere = false;
};

// `turn` is of the light's points about its axis, in turns. False where the light is too far away.
bool see(const AreaLight& light, const glm::vec3& origin, double turn, SeenLight& seen);

// Fills components and `cast` of `rays`: from its origin to the points of the light, multiplied by `share`. Cast are
// those above the horizon of rays.up that have a length. Every instruction set gives the same bits.
void aim_at_light(const PatternLanes& disk, const SeenLight& light, float share, ReceiverRays& rays);

}  // namespace lkao::query
