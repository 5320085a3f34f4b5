// The last step of the default pattern: evens out what ambient occlusion is sensitive to.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "lkao/weighting.h"

namespace lkao::lut {

// Puts the radii at equal areas (restore_equal_areas), then turns points about the centre, and lets points trade
// radii, so that every half-space holds the share of directions that is due to it, where the points become directions
// of that weighting. Local changes only: what was irregular stays so. Leaves the points in the order of their radii.
//
// Based on: R. Alexander, "Principles of a new method in the study of irregularities of distribution", Inventiones
// Mathematicae 103, 1991, and K. B. Stolarsky, "Sums of distances between points on a sphere. II", Proceedings of the
// AMS 41, 1973: the mean squared error with which points fill half-spaces is least where the sum of their distances
// is largest. lut/README.md tells the rest.
void balance(std::vector<glm::dvec2>& points, std::uint64_t seed, Weighting weighting);

}  // namespace lkao::lut
