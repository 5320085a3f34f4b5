#include "rays_cell.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <utility>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "cli/median.h"
#include "cli/stopwatch.h"
#include "embree_modes.h"
#include "lkao/isa.h"
#include "reference/embree_reference.h"

namespace lkao::bench {
namespace {

using Masks = std::vector<std::uint64_t>;

struct Method {
  std::string name;
  std::string isa;
  int round_count;
  std::function<void(Masks&)> answer;
  std::vector<double> seconds = {};  // a round each
  Masks masks = {};
};

template <typename Results, typename Test>
const MethodResult& fastest(const Results& results, const Test& test) {
  const MethodResult* best = nullptr;
  for (const MethodResult& result : results) {
    if (test(result.method) && (best == nullptr || result.mrays_per_second > best->mrays_per_second)) best = &result;
  }
  return *best;
}

void run_rounds(std::vector<Method>& methods, int round_count) {
  for (int round = 0; round < round_count; ++round) {
    for (Method& method : methods) {
      if (round >= method.round_count) continue;
      force_isa(method.isa);
      const cli::Stopwatch time;
      method.answer(method.masks);
      method.seconds.push_back(time.seconds());
    }
  }
}

}  // namespace

const MethodResult& Cell::scalar() const {
  return fastest(results, [](std::string_view name) { return name == kScalarMethod; });
}

const MethodResult& Cell::best_embree() const {
  return fastest(results, [](std::string_view name) { return name.starts_with("embree"); });
}

const MethodResult& Cell::occluded1() const {
  return fastest(results, [](std::string_view name) { return name.starts_with("embree1_"); });
}

void measure(const CellInput& input, const MeasureOptions& options, Cell& cell) {
  const SamplePattern& pattern = SamplePattern::standard(cell.ray_count);
  const auto make_query = [&](Kernel kernel) {
    return AmbientOcclusion(*input.occluders, pattern, {.radius = cell.radius, .kernel = kernel});
  };
  const AmbientOcclusion simd = make_query(Kernel::simd);
  const AmbientOcclusion scalar = make_query(Kernel::scalar);

  Masks expected(input.receivers.size() * static_cast<std::size_t>(pattern.word_count()));
  const std::uint64_t ray_count = input.oracle->query(simd, input.receivers, {.mask_words = expected}).ray_count;

  std::vector<Method> methods;
  const auto add_kernel = [&](const char* name, const std::string& isa, int rounds, const AmbientOcclusion& ao) {
    methods.push_back({name, isa, rounds, [&](Masks& masks) { ao.query(input.receivers, {.mask_words = masks}); }});
  };
  const std::string& main_isa = cell.isas.front();
  for (const std::string& isa : cell.isas) add_kernel(kSimdMethod, isa, options.round_count, simd);
  add_kernel(kScalarMethod, main_isa, 1, scalar);
  for (const EmbreeMode& mode : all_embree_modes()) {
    methods.push_back({mode.name(), main_isa, options.round_count,
                       [&, mode](Masks& masks) { cast(mode, input.rival->plain(), simd, input.receivers, masks); }});
  }
  for (Method& method : methods) method.masks.resize(expected.size());

  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(options.thread_count));
  tbb::task_arena(options.thread_count).execute([&] { run_rounds(methods, options.round_count); });

  const double rays = static_cast<double>(ray_count);
  for (const Method& method : methods) {
    cell.results.push_back({method.name, method.isa, rays / cli::median(method.seconds) * 1e-6,
                            static_cast<double>(reference::count_mismatched_rays(method.masks, expected)) / rays});
  }
}

}  // namespace lkao::bench
