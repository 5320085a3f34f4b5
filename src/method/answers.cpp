#include "method/answers.h"

#include <cstddef>

#include "method/median.h"
#include "method/stopwatch.h"
#include "reference/embree_reference.h"

namespace lkao::method {
namespace {

// `answer(outputs)` gives Answered.
template <class Answer>
Answers ask_in_rounds(const Answer& answer, std::size_t receiver_count, std::size_t mask_size, int round_count) {
  Answers answers;
  answers.occlusion.resize(receiver_count);
  answers.masks.resize(mask_size);
  std::vector<double> seconds;
  for (int round = 0; round < round_count; ++round) {
    const Answered answered = answer(QueryOutputs{.occlusion = answers.occlusion, .mask_words = answers.masks});
    answers.ray_count = answered.report.ray_count;
    seconds.push_back(answered.seconds);
  }
  answers.seconds = median(seconds);
  return answers;
}

}  // namespace

Answers ask(Method& method, int word_count, std::span<const Receiver> receivers, int round_count) {
  const std::size_t mask_size = method.abilities().masks ? receivers.size() * static_cast<std::size_t>(word_count) : 0;
  return ask_in_rounds([&](const QueryOutputs& outputs) { return method.answer(receivers, outputs, 0); },
                       receivers.size(), mask_size, round_count);
}

Answers ask(const AmbientOcclusion& query, std::span<const Receiver> receivers, int round_count) {
  const auto answer = [&](const QueryOutputs& outputs) {
    const Stopwatch watch;
    const QueryReport report = query.query(receivers, outputs);
    return Answered{report, watch.seconds()};
  };
  const auto word_count = static_cast<std::size_t>(query.pattern().word_count());
  return ask_in_rounds(answer, receivers.size(), receivers.size() * word_count, round_count);
}

Deviation deviation(const Answers& answers, const Answers& right) {
  std::optional<std::uint64_t> wrong_ray_count;
  if (!answers.masks.empty() && !right.masks.empty()) {
    wrong_ray_count = reference::count_mismatched_rays(answers.masks, right.masks);
  }
  return deviation(answers.occlusion, right.occlusion, wrong_ray_count, right.ray_count);
}

}  // namespace lkao::method
