// Cutting a triangle's bounds in two, for spatial splits.
#pragma once

#include <glm/vec3.hpp>

#include "lkao/occluder_bvh.h"

namespace lkao::bvh {

struct SplitBounds {
  Bounds left;
  Bounds right;
};

// Bounds of the parts of a triangle on either side of the plane `axis` = `position`, both within `within` (the bounds
// of the piece that is being split). Rounded outwards, so that the two boxes together hold every point of the triangle
// inside `within`.
SplitBounds clip_triangle(const glm::vec3 (&corners)[3], const Bounds& within, int axis, float position);

}  // namespace lkao::bvh
