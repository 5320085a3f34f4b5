#include "method/question.h"

#include <cmath>

#include <fmt/format.h>
#include <tbb/task_arena.h>

namespace lkao::method {
namespace {

bool is_constant(const Falloff& falloff) { return falloff.name() == Falloff::constant().name(); }

}  // namespace

SamplePattern Question::pattern() const {
  const SamplePattern& pattern = SamplePattern::standard(ray_count, weighting);
  return is_constant(falloff) ? pattern : pattern.with_falloff(falloff);
}

PlaneMaskTable Question::table(PlaneMasks masks) const {
  PlaneMaskTableOptions options;
  options.masks = masks;
  options.thread_count = tbb::this_task_arena::max_concurrency();
  return PlaneMaskTable(pattern(), options);
}

std::string Question::special_rays() const {
  const Question usual;
  if (weighting != usual.weighting) return fmt::format("--weighting {}", word_of(kWeightingWords, weighting));
  if (!is_constant(falloff)) return fmt::format("--falloff {}", falloff.name());
  if (sidedness != usual.sidedness) return fmt::format("--sided {}", word_of(kSidednessWords, sidedness));
  if (min_distance != usual.min_distance) return fmt::format("--min-distance {:g}", min_distance);
  return {};
}

bool Question::has_infinite_lengths() const { return std::isinf(radius) && !is_constant(falloff); }

}  // namespace lkao::method
