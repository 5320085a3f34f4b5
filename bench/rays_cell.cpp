#include "bench/rays_cell.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <glm/common.hpp>

#include "bench/embree_modes.h"
#include "bench/work_clock.h"
#include "lkao/isa.h"
#include "lkao/neighbourhood.h"
#include "method/median.h"

namespace lkao::bench {
namespace {

using Masks = std::vector<std::uint64_t>;

struct Method {
  std::string name;
  int round_count;
  std::function<void(Masks&)> answer;
  std::vector<double> seconds = {};  // a round each
  Masks masks = {};
};

template <typename Test>
const MethodResult* fastest(const std::vector<MethodResult>& results, const Test& test) {
  const MethodResult* best = nullptr;
  for (const MethodResult& result : results) {
    if (test(result.method) && (best == nullptr || result.mrays_per_second > best->mrays_per_second)) best = &result;
  }
  return best;
}

// What a renderer does that has no batches: a call for every receiver.
void query_singly(const AmbientOcclusion& ao, std::span<const Receiver> receivers, Masks& masks) {
  const auto word_count = static_cast<std::size_t>(ao.pattern().word_count());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, receivers.size(), 32), [&](const auto& range) {
    for (std::size_t k = range.begin(); k < range.end(); ++k) {
      const ReceiverOcclusion answer = ao.query(receivers[k], k);
      std::copy_n(answer.mask.words, word_count, masks.data() + k * word_count);
    }
  });
}

// What one does that shades tile by tile.
void query_around(const AmbientOcclusion& ao, std::span<const Receiver> receivers, Masks& masks) {
  const auto word_count = static_cast<std::size_t>(ao.pattern().word_count());
  const auto answer_tile = [&](const tbb::blocked_range<std::size_t>& range) {
    Bounds positions{receivers[range.begin()].position, receivers[range.begin()].position};
    for (const Receiver& receiver : receivers.subspan(range.begin(), range.size())) {
      positions = {glm::min(positions.lower, receiver.position), glm::max(positions.upper, receiver.position)};
    }
    Neighbourhood here = ao.around(positions);
    for (std::size_t k = range.begin(); k < range.end(); ++k) {
      std::copy_n(here.blocked(receivers[k], k).words, word_count, masks.data() + k * word_count);
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, receivers.size(), 64), answer_tile, tbb::simple_partitioner());
}

// Each answer is timed the second time: a method finds its own data in the caches, whichever was before it.
void run_rounds(std::vector<Method>& methods, const MeasureOptions& options, int thread_count) {
  for (int round = 0; round < options.round_count; ++round) {
    for (Method& method : methods) {
      if (round >= method.round_count) continue;
      method.answer(method.masks);
      const WorkClock time(thread_count);
      method.answer(method.masks);
      method.seconds.push_back(time.seconds());
    }
  }
}

void run_on_threads(std::vector<Method>& methods, const MeasureOptions& options, int thread_count) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(thread_count));
  tbb::task_arena(thread_count).execute([&] { run_rounds(methods, options, thread_count); });
}

struct Queries {
  AmbientOcclusion simd;
  AmbientOcclusion scalar;
};

Queries make_queries(const CellInput& input, const Cell& cell) {
  const SamplePattern& pattern = SamplePattern::standard(cell.ray_count);
  const auto make = [&](Kernel kernel) {
    return AmbientOcclusion(*input.occluders, pattern, {.radius = cell.radius}, kernel);
  };
  return {make(Kernel::simd), make(Kernel::scalar)};
}

// Cell::simd, single and around count on their places.
std::vector<Method> make_methods(const CellInput& input, const Queries& queries, int round_count, bool with_scalar) {
  const std::span<const Receiver> receivers = input.receivers;
  const auto batch = [receivers](const AmbientOcclusion& ao) {
    return [receivers, &ao](Masks& masks) { ao.query(receivers, {.mask_words = masks}); };
  };
  const AmbientOcclusion& simd = queries.simd;
  std::vector<Method> methods = {
      {kSimdMethod, round_count, batch(simd)},
      {kSingleMethod, round_count, [receivers, &simd](Masks& masks) { query_singly(simd, receivers, masks); }},
      {kAroundMethod, round_count, [receivers, &simd](Masks& masks) { query_around(simd, receivers, masks); }}};
  if (with_scalar) methods.push_back({kScalarMethod, 1, batch(queries.scalar)});
  for (const EmbreeMode& mode : all_embree_modes()) {
    methods.push_back({mode.name(), round_count, [receivers, &simd, mode, rival = input.rival](Masks& masks) {
                         cast(mode, rival->plain(), simd, receivers, masks);
                       }});
  }
  return methods;
}

std::vector<MethodResult> results_of(const std::vector<Method>& methods, const Masks& expected, double ray_count) {
  std::vector<MethodResult> results;
  for (const Method& method : methods) {
    const auto mismatched_count = static_cast<double>(reference::count_mismatched_rays(method.masks, expected));
    results.push_back(
        {method.name, method.seconds, ray_count / method::median(method.seconds) * 1e-6, mismatched_count / ray_count});
  }
  return results;
}

}  // namespace

double speed_ratio(const MethodResult& a, const MethodResult& b) {
  std::vector<double> ratios;
  for (std::size_t round = 0; round < std::min(a.seconds.size(), b.seconds.size()); ++round) {
    ratios.push_back(b.seconds[round] / a.seconds[round]);
  }
  return method::median(ratios);
}

const MethodResult* Cell::scalar() const {
  return fastest(results, [](std::string_view name) { return name == kScalarMethod; });
}

const MethodResult& Cell::best_embree() const {
  return *fastest(results, [](std::string_view name) { return name.starts_with("embree"); });
}

const MethodResult& Cell::occluded1() const {
  return *fastest(results, [](std::string_view name) { return name.starts_with("embree1_"); });
}

std::vector<Cell> measure(const CellInput& input, const MeasureOptions& options, const Cell& question,
                          bool with_scalar) {
  force_isa(question.isa.lkao);
  const Queries queries = make_queries(input, question);
  Masks expected(input.receivers.size() * static_cast<std::size_t>(queries.simd.pattern().word_count()));
  const std::uint64_t ray_count =
      input.oracle->query(queries.simd, input.receivers, {.mask_words = expected}).ray_count;

  std::vector<Cell> cells;
  for (const int thread_count : options.thread_counts) {
    std::vector<Method> methods = make_methods(input, queries, options.round_count, with_scalar && cells.empty());
    for (Method& method : methods) method.masks.resize(expected.size());
    run_on_threads(methods, options, thread_count);
    Cell cell = question;
    cell.thread_count = thread_count;
    cell.results = results_of(methods, expected, static_cast<double>(ray_count));
    cells.push_back(std::move(cell));
  }
  return cells;
}

}  // namespace lkao::bench
