// What a study of sample patterns compares.
#pragma once

#include <vector>

#include "bench/pattern_errors.h"

namespace lkao::bench {

// In the order of PatternKind.
inline constexpr PatternKind kPatternKinds[] = {PatternKind::lloyd, PatternKind::paper, PatternKind::fibonacci,
                                                PatternKind::sobol, PatternKind::random};
inline constexpr int kStudyRayCounts[] = {1, 4, 16, 48, 64, 100, 128, 200, 256, 512, 1024};
inline constexpr Jitter kPlainJitter{.rotation = 1, .tilt = 0};

// The plain one among them.
std::vector<Jitter> study_jitters();

// Every kind with every ray count; then the default with every other jitter.
std::vector<PatternCase> study_cases();

}  // namespace lkao::bench
