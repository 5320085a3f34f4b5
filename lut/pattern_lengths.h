// Which ray is how long: joint stratification of directions and lengths.
#pragma once

#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "lkao/weighting.h"

namespace lkao::lut {

// Deals the shares 0 to count - 1 to points on the unit disk, one each; share k stands for the lengths that
// Falloff::length_at gives for (k + 1/2) / count, so share 0 is the longest ray. Every region of directions gets its
// part of every range of shares, for every falloff: neighbours get shares far apart, and so do points of one radius.
// `weighting` is that of the directions above the points. Depends on these two alone. Tens of milliseconds for 1024
// points.
std::vector<int> deal_shares(std::span<const glm::vec2> points, Weighting weighting);

}  // namespace lkao::lut
