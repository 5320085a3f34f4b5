#include "method/question.h"

#include <cmath>

namespace lkao::method {
namespace {

bool is_constant(const Falloff& falloff) { return falloff.name() == Falloff::constant().name(); }

}  // namespace

SamplePattern Question::pattern() const {
  const SamplePattern& pattern = SamplePattern::standard(ray_count);
  return is_constant(falloff) ? pattern : pattern.with_falloff(falloff);
}

PlaneMaskTable Question::table(PlaneMasks masks) const {
  PlaneMaskTableOptions options;
  options.masks = masks;
  return PlaneMaskTable(pattern(), options);
}

bool Question::has_infinite_lengths() const { return std::isinf(radius) && !is_constant(falloff); }

}  // namespace lkao::method
