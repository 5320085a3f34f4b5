#include "answers.h"

#include <cmath>
#include <cstddef>

#include "cli/median.h"
#include "cli/stopwatch.h"
#include "reference/embree_reference.h"

namespace lkao::bench {
namespace {

double mean_change(std::span<const float> values, std::span<const float> from) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i]) || std::isnan(from[i])) continue;
    sum += static_cast<double>(values[i]) - static_cast<double>(from[i]);
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

}  // namespace

std::vector<Answers> ask(std::span<const AmbientOcclusion> queries, std::span<const Receiver> receivers,
                         int round_count) {
  std::vector<Answers> answers(queries.size());
  std::vector<std::vector<double>> seconds(queries.size());
  for (int round = 0; round < round_count; ++round) {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      Answers& own = answers[i];
      own.occlusion.resize(receivers.size());
      own.masks.resize(receivers.size() * static_cast<std::size_t>(queries[i].pattern().word_count()));
      const cli::Stopwatch time;
      own.ray_count = queries[i].query(receivers, {.occlusion = own.occlusion, .mask_words = own.masks}).ray_count;
      seconds[i].push_back(time.seconds());
    }
  }
  for (std::size_t i = 0; i < queries.size(); ++i) answers[i].seconds = cli::median(seconds[i]);
  return answers;
}

Deviation deviation(std::span<const float> occlusion, std::span<const std::uint64_t> masks, const Answers& exact) {
  const std::uint64_t wrong_count = reference::count_mismatched_rays(masks, exact.masks);
  return {wrong_count, static_cast<double>(wrong_count) / static_cast<double>(exact.ray_count),
          mean_change(occlusion, exact.occlusion), image::compare(occlusion, exact.occlusion)};
}

}  // namespace lkao::bench
