// Answering many receivers in parallel.
#pragma once

#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>
#include <tbb/partitioner.h>

#include "lkao/progress.h"
#include "lut/progress_sum.h"
#include "query/answer.h"

namespace lkao::query {

// Calls `answer_part(first, last)`, which returns its report, for parts of the receivers in parallel, in the caller's
// arena; returns the sum of the reports. Parts are so small that threads are busy to the end, and large enough to hide
// the scheduler. Throws Cancelled where `progress` stops it.
template <typename AnswerPart>
QueryReport answer_in_parts(std::size_t receiver_count, const Progress& progress, const AnswerPart& answer_part) {
  constexpr std::size_t kGrain = 64;
  using Range = tbb::blocked_range<std::size_t>;
  lut::ProgressSum sum(progress, receiver_count);
  return tbb::parallel_reduce(
      Range(0, receiver_count, kGrain), QueryReport{},
      [&](const Range& range, QueryReport report) {
        report += answer_part(range.begin(), range.end());
        sum.add(range.size());
        return report;
      },
      [](QueryReport a, const QueryReport& b) {
        a += b;
        return a;
      },
      tbb::simple_partitioner());
}

}  // namespace lkao::query
