// Whether rounding explains why two ray casters disagree.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lkao/ambient_occlusion.h"

namespace lkao::bench {

// Of the rays whose bits differ between the two sets of masks (as in QueryOutputs, receiver k with index k), those that
// rounding does not explain: the definition itself gives them the same answer when the ray is moved by a few steps of
// float of its origin's size, any way, and made as much longer or shorter.
std::uint64_t count_unexplained(const AmbientOcclusion& ao, std::span<const Receiver> receivers,
                                std::span<const std::uint64_t> masks, std::span<const std::uint64_t> expected);

}  // namespace lkao::bench
