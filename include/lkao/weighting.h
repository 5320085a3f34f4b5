// What the mean over the rays of a sample pattern stands for.
#pragma once

#include "lkao/requirements.h"

namespace lkao {

// How densely directions are spread over the hemisphere. Every ray counts the same, so this is what decides by how much
// a region of the hemisphere darkens. Seen from the foot of a wall under an open sky, up to the angle b above the
// horizon, occlusion is (1 - cos b) / 2 with `cosine` and b / pi with `uniform`; under a disk whose rim is at the angle
// a from the normal, sin^2 a and 1 - cos a.
enum class Weighting {
  // In proportion to the cosine of the angle to the normal, as light from an even sky brightens a matt surface: ambient
  // occlusion as renderers define it. The mean height (z) of the directions is 2/3.
  cosine,
  // Evenly by solid angle: the share of the hemisphere that is blocked, as aobaker and libigl have it. What stands low
  // counts for more. The mean height is 1/2.
  uniform,
};

}  // namespace lkao
