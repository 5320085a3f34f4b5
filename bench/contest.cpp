#include "bench/contest.h"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "bench/work_clock.h"
#include "method/median.h"
#include "reference/embree_reference.h"

namespace lkao::bench {

void run_rounds(std::vector<Rival>& rivals, int thread_count) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(thread_count));
  int most_rounds = 0;
  for (const Rival& rival : rivals) most_rounds = std::max(most_rounds, rival.round_count);
  tbb::task_arena(thread_count).execute([&] {
    for (int round = 0; round < most_rounds; ++round) {
      for (Rival& rival : rivals) {
        if (round >= rival.round_count) continue;
        rival.answer(rival.masks);
        const WorkClock time(thread_count);
        rival.answer(rival.masks);
        rival.seconds.push_back(time.seconds());
      }
    }
  });
}

std::string timing_remark(int round_count) {
  return fmt::format("time: CPU time for one thread, wall time for several; median of {} rounds", round_count);
}

MethodResult result_of(const Rival& rival, const Masks& expected, double ray_count) {
  const auto mismatched_count = static_cast<double>(reference::count_mismatched_rays(rival.masks, expected));
  return {rival.name, rival.seconds, ray_count / method::median(rival.seconds) * 1e-6, mismatched_count / ray_count};
}

double speed_ratio(const MethodResult& a, const MethodResult& b) {
  std::vector<double> ratios;
  for (std::size_t round = 0; round < std::min(a.seconds.size(), b.seconds.size()); ++round) {
    ratios.push_back(b.seconds[round] / a.seconds[round]);
  }
  return method::median(ratios);
}

const MethodResult* fastest(std::span<const MethodResult> results, std::string_view prefix) {
  const MethodResult* best = nullptr;
  for (const MethodResult& result : results) {
    if (!result.method.starts_with(prefix)) continue;
    if (best == nullptr || result.mrays_per_second > best->mrays_per_second) best = &result;
  }
  return best;
}

}  // namespace lkao::bench
