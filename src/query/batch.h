// Answering many receivers in parallel.
#pragma once

#include <functional>
#include <span>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "query/answer.h"

namespace lkao::query {

// Calls `trace(receiver, index, rays)` for every receiver, in parallel in the caller's arena; it fills `rays` with the
// rays it casts and returns those that are blocked. Stores and counts the answers. The parts are so small that threads
// are busy to the end, and large enough to hide the scheduler.
template <typename Trace>
QueryReport run_batch(const SamplePattern& pattern, std::span<const Receiver> receivers, const QueryOutputs& outputs,
                      std::uint64_t first_index, const Trace& trace) {
  constexpr std::size_t kGrain = 32;
  require_sizes(outputs, receivers.size(), pattern.word_count());
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, receivers.size(), kGrain), QueryReport{},
      [&](const tbb::blocked_range<std::size_t>& range, QueryReport report) {
        ReceiverRays rays;
        for (std::size_t k = range.begin(); k < range.end(); ++k) {
          const OcclusionMask blocked = trace(receivers[k], first_index + k, rays);
          store(outputs, k, pattern, receivers[k], rays, blocked);
          count(report, rays, blocked);
        }
        return report;
      },
      [](QueryReport a, const QueryReport& b) {
        add(a, b);
        return a;
      });
}

}  // namespace lkao::query
