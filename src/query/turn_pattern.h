// The arithmetic of make_rays, for many rays at once.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "lkao/ambient_occlusion.h"
#include "query/receiver_rays.h"

namespace lkao::query {

// Fills rays.x, y, z with frame x direction x length x radius of every ray of the pattern, and rays.cast with those
// whose direction is above the horizon of `up`. Every instruction set gives the same bits.
void turn_pattern(const PatternLanes& pattern, const glm::mat3& frame, float radius, const glm::vec3& up,
                  ReceiverRays& rays);

}  // namespace lkao::query
