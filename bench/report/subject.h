// What a report asks about: a view of a scene at one AO radius, and what is right there.
#pragma once

#include <string>
#include <vector>

#include "bench/report/errors.h"
#include "bench/report/store.h"
#include "bench/study_scenes.h"
#include "lkao/sample_pattern.h"

namespace lkao::bench {

// Rays of one falloff, in two halves that share no directions: what each half misses of the other tells how far the
// mean of both may be off.
struct Converged {
  std::vector<float> mean;  // of both halves
  PictureErrors between_halves;
  int ray_count = 0;  // of the mean
};

struct Subject {
  Subject(const StudyScene& study_scene, float ao_radius);

  const StudyScene& scene;
  float radius;
  std::string name;  // scene and radius
  std::string key;   // for the store: another camera, size, or mesh that is seen, is another subject
};

// From the store, or cast and put there: 2 x `turn_count` times 1024 rays a pixel.
Converged converge(const Subject& subject, const Falloff& falloff, int turn_count, const ReportStore& store);

}  // namespace lkao::bench
