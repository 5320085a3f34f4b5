// Each kind of pattern as a recipe of points on the unit disk.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "lkao/pattern_kind.h"
#include "lkao/weighting.h"

namespace lkao::lut {

// Spread evenly over the disk, whatever the weighting: for Weighting::uniform they still have to be moved by
// to_uniform(). In any order; the points of `random` and `sobol` come as near to the edge of the disk as rounding
// allows.
std::vector<glm::dvec2> pattern_points(PatternKind kind, int point_count, std::uint64_t seed, Weighting weighting);

}  // namespace lkao::lut
