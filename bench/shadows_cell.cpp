#include "bench/shadows_cell.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "bench/embree_modes.h"
#include "lkao/isa.h"

namespace lkao::bench {
namespace {

void query_one_by_one(const SoftShadows& shadows, std::span<const Receiver> receivers, Masks& masks) {
  const auto word_count = static_cast<std::size_t>(shadows.pattern().word_count());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, receivers.size(), 32), [&](const auto& range) {
    for (std::size_t k = range.begin(); k < range.end(); ++k) {
      const LightVisibility answer = shadows.query(receivers[k], k);
      std::copy_n(answer.blocked.words, word_count, masks.data() + k * word_count);
    }
  });
}

std::vector<Rival> make_rivals(const CellInput& input, const SoftShadows& shadows, int round_count) {
  const std::span<const Receiver> receivers = input.receivers;
  const Masks masks(receivers.size() * static_cast<std::size_t>(shadows.pattern().word_count()));
  const auto in_batches = [receivers, &shadows](Masks& to) { shadows.query(receivers, {.mask_words = to}); };
  const auto one_by_one = [receivers, &shadows](Masks& to) { query_one_by_one(shadows, receivers, to); };
  std::vector<Rival> rivals = {{kShadowsMethod, round_count, in_batches, masks},
                               {kSingleShadowsMethod, round_count, one_by_one, masks}};
  for (const EmbreeMode& mode : all_embree_modes()) {
    const auto make = [receivers, &shadows](std::size_t k, ReceiverRays& rays) { shadows.rays(receivers[k], k, rays); };
    const RaySource source{receivers.size(), shadows.pattern().ray_count(), make};
    const auto answer = [mode, source, rival = input.rival](Masks& to) { cast(mode, rival->plain(), source, to); };
    rivals.push_back({mode.name(), round_count, answer, masks});
  }
  return rivals;
}

// What robust Embree says with the same rays.
struct Expected {
  Masks masks;
  std::vector<float> visibility, above_horizon;
  double ray_count;
};

Expected ask_oracle(const CellInput& input, const SoftShadows& shadows) {
  const std::size_t count = input.receivers.size();
  Expected expected{Masks(count * static_cast<std::size_t>(shadows.pattern().word_count())), std::vector<float>(count),
                    std::vector<float>(count), 0};
  const ShadowOutputs outputs{expected.visibility, expected.above_horizon, expected.masks};
  expected.ray_count = static_cast<double>(input.oracle->query(shadows, input.receivers, outputs).ray_count);
  return expected;
}

double share_of(const Expected& expected, const std::function<bool(float, float)>& test) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < expected.visibility.size(); ++k) {
    count += test(expected.visibility[k], expected.above_horizon[k]);
  }
  return static_cast<double>(count) / static_cast<double>(expected.visibility.size());
}

double error_of(const SoftShadows& shadows, std::span<const Receiver> receivers, const Expected& expected) {
  std::vector<float> visibility(receivers.size());
  shadows.query(receivers, {.visibility = visibility});
  double sum = 0;
  for (std::size_t k = 0; k < visibility.size(); ++k) {
    sum += std::fabs(static_cast<double>(visibility[k]) - static_cast<double>(expected.visibility[k]));
  }
  return sum / static_cast<double>(visibility.size());
}

}  // namespace

const MethodResult& ShadowsCell::best_embree() const { return *fastest(results, "embree"); }

std::vector<ShadowsCell> measure_shadows(const CellInput& input, const AreaLight& light, const MeasureOptions& options,
                                         const ShadowsCell& question) {
  force_isa(question.isa.lkao);
  const SoftShadows shadows(*input.occluders, light, SamplePattern::standard(question.ray_count));
  const Expected expected = ask_oracle(input, shadows);
  std::vector<ShadowsCell> cells;
  for (const int thread_count : options.thread_counts) {
    std::vector<Rival> rivals = make_rivals(input, shadows, options.round_count);
    run_rounds(rivals, thread_count);
    ShadowsCell cell = question;
    cell.thread_count = thread_count;
    for (const Rival& rival : rivals) cell.results.push_back(result_of(rival, expected.masks, expected.ray_count));
    cell.lit_share = share_of(expected, [](float seen, float above) { return above > 0 && seen == above; });
    cell.umbra_share = share_of(expected, [](float seen, float) { return seen == 0; });
    cell.mae = error_of(shadows, input.receivers, expected);
    cells.push_back(std::move(cell));
  }
  return cells;
}

}  // namespace lkao::bench
