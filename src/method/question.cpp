#include "method/question.h"

#include <cmath>

#include <tbb/task_arena.h>

namespace lkao::method {
namespace {

bool is_constant(const Falloff& falloff) { return falloff.name() == Falloff::constant().name(); }

}  // namespace

SamplePattern Question::pattern() const {
  if (pattern_kind != PatternKind::lloyd) return SamplePattern::make(pattern_kind, ray_count, falloff, 0, weighting);
  const SamplePattern& pattern = SamplePattern::standard(ray_count, weighting);
  return is_constant(falloff) ? pattern : pattern.with_falloff(falloff);
}

PlaneMaskTable Question::table(PlaneMasks masks) const {
  PlaneMaskTableOptions options;
  options.masks = masks;
  options.resolution = table_resolution;
  options.thread_count = tbb::this_task_arena::max_concurrency();
  return PlaneMaskTable(pattern(), options);
}

bool Question::has_infinite_lengths() const { return std::isinf(radius) && !is_constant(falloff); }

}  // namespace lkao::method
