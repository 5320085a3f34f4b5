// All that is answered for some receivers, masks too, and its time over several rounds: for studies.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "method/deviation.h"
#include "method/method.h"

namespace lkao::method {

struct Answers {
  std::vector<float> occlusion;
  std::vector<std::uint64_t> masks;  // none where the method does not tell ray by ray
  std::uint64_t ray_count = 0;
  double seconds = 0;  // the median of the rounds
};

// Receiver k has index k. The method must be prepared; `word_count` is its pattern's.
Answers ask(Method& method, int word_count, std::span<const Receiver> receivers, int round_count);
Answers ask(const AmbientOcclusion& query, std::span<const Receiver> receivers, int round_count);

// Ray by ray where both have masks.
Deviation deviation(const Answers& answers, const Answers& right);

}  // namespace lkao::method
