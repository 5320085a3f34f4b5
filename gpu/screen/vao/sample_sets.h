// Where the line samples of a pixel lie: sets of 2, 4, 8, 16 and 32 places in the unit disc.
//
// Based on: J. Boksansky, A. Pospisil, J. Bittner, "VAO++: Practical Volumetric Ambient Occlusion for Games", EGSR 2017
// (Experimental Ideas & Implementations), Sec. 4.5.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace lkao::gl {

// Neighbouring pixels turn a set by one ninth each, so that 3 x 3 of them have nine times as many places.
inline constexpr int kSampleRotationCount = 9;
inline constexpr std::array kSampleSetSizes = {2, 4, 8, 16, 32};
inline constexpr int kSampleSetTotal = 62;

// A set of `count` places, in z-order. Any two of its nine rotations' places are `spacing` apart, and as far from their
// own rotations; none is nearer to the edge of the disc than a third of that, so that the disc is covered evenly.
// Of all the ways to turn single places by ninths, which the nine rotations together do not see, it is one that places
// the set's own places far from each other.
struct SampleSet {
  std::vector<glm::dvec2> places;
  double spacing = 0;
};
SampleSet make_sample_set(int count, std::uint64_t seed = 1);

// All sets, one after the other by size: that of n places begins at n - 2. Made when first asked for, in some
// milliseconds; the same on every machine.
const std::array<glm::vec2, kSampleSetTotal>& sample_sets();

}  // namespace lkao::gl
