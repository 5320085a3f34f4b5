// Answering many receivers in parallel.
#pragma once

#include <functional>
#include <span>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "query/answer.h"

namespace lkao::query {

// Runs `answer(receiver, index, rays)` for every receiver, in parallel in the caller's arena, and stores and counts the
// answers. `rays` is scratch space that `answer` fills with the rays it cast. The parts are so small that threads are
// busy to the end, and large enough to hide the scheduler.
template <typename Answer>
QueryReport run_batch(std::span<const Receiver> receivers, const QueryOutputs& outputs, int word_count,
                      std::uint64_t first_index, const Answer& answer) {
  constexpr std::size_t kGrain = 32;
  require_sizes(outputs, receivers.size(), word_count);
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, receivers.size(), kGrain), QueryReport{},
      [&](const tbb::blocked_range<std::size_t>& range, QueryReport report) {
        ReceiverRays rays;
        for (std::size_t k = range.begin(); k < range.end(); ++k) {
          const ReceiverOcclusion result = answer(receivers[k], first_index + k, rays);
          store(outputs, k, word_count, result);
          count(report, rays, result);
        }
        return report;
      },
      [](QueryReport a, const QueryReport& b) {
        add(a, b);
        return a;
      });
}

}  // namespace lkao::query
