// Answering many receivers in parallel.
#pragma once

#include <functional>
#include <span>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>
#include <tbb/partitioner.h>

#include "lkao/progress.h"
#include "lut/progress_sum.h"
#include "query/answer.h"

namespace lkao::query {

// Calls `answer_part(first, last, take)` for parts of the receivers, in parallel in the caller's arena; it calls
// `take(k, rays, blocked)` for every receiver of its part, with the rays that receiver k casts and those that are
// blocked. Stores and counts the answers. Parts are so small that threads are busy to the end, and large enough to hide
// the scheduler. Throws Cancelled where `progress` stops it.
template <typename AnswerPart>
QueryReport run_batch(const SamplePattern& pattern, std::span<const Receiver> receivers, const QueryOutputs& outputs,
                      const AnswerPart& answer_part, const Progress& progress = {}) {
  constexpr std::size_t kGrain = 64;
  require_sizes(outputs, receivers.size(), pattern.word_count());
  lut::ProgressSum sum(progress, receivers.size());
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, receivers.size(), kGrain), QueryReport{},
      [&](const tbb::blocked_range<std::size_t>& range, QueryReport report) {
        answer_part(range.begin(), range.end(),
                    [&](std::size_t k, const ReceiverRays& rays, const OcclusionMask& blocked) {
                      store(outputs, k, pattern, receivers[k], rays, blocked);
                      count(report, rays, blocked);
                    });
        sum.add(range.size());
        return report;
      },
      [](QueryReport a, const QueryReport& b) {
        add(a, b);
        return a;
      },
      tbb::simple_partitioner());
}

}  // namespace lkao::query
