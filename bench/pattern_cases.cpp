#include "bench/pattern_cases.h"

namespace lkao::bench {
namespace {

bool is_plain(const Jitter& jitter) {
  return jitter.rotation == kPlainJitter.rotation && jitter.tilt == kPlainJitter.tilt;
}

}  // namespace

std::vector<Jitter> study_jitters() {
  std::vector<Jitter> jitters;
  for (float rotation : {1.0f, 0.125f, 0.0f}) {
    for (float tilt : {0.0f, 0.02f, 0.05f}) jitters.push_back({rotation, tilt});
  }
  return jitters;
}

std::vector<PatternCase> study_cases() {
  std::vector<PatternCase> cases;
  for (PatternKind kind : kPatternKinds) {
    for (int ray_count : kStudyRayCounts) cases.push_back({kind, ray_count, kPlainJitter});
  }
  for (const Jitter& jitter : study_jitters()) {
    if (is_plain(jitter)) continue;
    for (int ray_count : {128, 1024}) cases.push_back({PatternKind::lloyd, ray_count, jitter});
  }
  return cases;
}

}  // namespace lkao::bench
