// Which of two ray casters is right where they disagree.
#pragma once

#include <cstdint>
#include <span>

#include "lkao/ambient_occlusion.h"

namespace lkao::bench {

// Rays of which two sets of masks say different things.
struct Disagreement {
  std::uint64_t first_wrong = 0;
  std::uint64_t second_wrong = 0;
  std::uint64_t undecided = 0;  // a corner, an edge or the ray's end is nearer than the precision tells
};

// Decides each ray whose bits differ between the two sets of masks (as in QueryOutputs; receiver k has index k) by
// itself, against every triangle of every instance that it may come near, in extended precision: rays and corners are
// the floats that `ao` takes them for, differences of them are exact, and signs count where rounding cannot have turned
// them. Shares no arithmetic with the queries but the slab test of the instances' boxes. Slow: some milliseconds a ray.
// Triangles with holes count as whole.
Disagreement decide_exactly(const AmbientOcclusion& ao, std::span<const Receiver> receivers,
                            std::span<const std::uint64_t> first, std::span<const std::uint64_t> second);

}  // namespace lkao::bench
