// What a query or a frame says of all receivers of a view, in what time, and how far that is from the exact answer.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "image/metrics.h"
#include "lkao/ambient_occlusion.h"

namespace lkao::bench {

struct Answers {
  std::vector<float> occlusion;
  std::vector<std::uint64_t> masks;
  std::uint64_t ray_count = 0;
  double seconds = 0;
};

// Of each query, which take turns, round after round; the median of their seconds.
std::vector<Answers> ask(std::span<const AmbientOcclusion> queries, std::span<const Receiver> receivers,
                         int round_count);

struct Deviation {
  std::uint64_t wrong_ray_count = 0;
  double mismatch_rate = 0;  // share of the rays whose answer is wrong
  double mean_change = 0;    // of the occlusion, over receivers where neither is NaN
  image::Metrics error;      // of the occlusion
};
Deviation deviation(std::span<const float> occlusion, std::span<const std::uint64_t> masks, const Answers& exact);
inline Deviation deviation(const Answers& answers, const Answers& exact) {
  return deviation(answers.occlusion, answers.masks, exact);
}

}  // namespace lkao::bench
