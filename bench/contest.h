// Several ways to the same masks, measured in turn.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lkao::bench {

using Masks = std::vector<std::uint64_t>;

struct Rival {
  std::string name;
  int round_count;
  std::function<void(Masks&)> answer;
  Masks masks;                       // as large as the answer
  std::vector<double> seconds = {};  // a round each, by WorkClock
};

// Round after round, all in turn, on so many threads of oneTBB. Each answer is timed the second time: a rival finds its
// own data in the caches, whichever was before it.
void run_rounds(std::vector<Rival>& rivals, int thread_count);

struct MethodResult {
  std::string method;
  std::vector<double> seconds;  // of each round, by WorkClock
  double mrays_per_second = 0;  // of rays above the horizon, making them included; the median of the rounds
  double mismatch_rate = 0;     // share of the rays whose answer differs from robust Embree's
};

// How their times are meant, for a CSV.
std::string timing_remark(int round_count);

// Of a rival that has run.
MethodResult result_of(const Rival& rival, const Masks& expected, double ray_count);

// How many times as fast as `b` is `a`: the median of the ratios inside the rounds that both ran, which slow changes of
// the processor's clock touch less than the ratio of the medians.
double speed_ratio(const MethodResult& a, const MethodResult& b);

// The fastest of those whose methods' names begin with `prefix`; null where there is none.
const MethodResult* fastest(std::span<const MethodResult> results, std::string_view prefix);

}  // namespace lkao::bench
