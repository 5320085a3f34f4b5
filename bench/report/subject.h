// What a report asks about: a view of a scene at one AO radius, and what is right there.
#pragma once

#include <string>
#include <vector>

#include "bench/report/contestants.h"
#include "bench/report/errors.h"
#include "bench/report/prepared_scene.h"
#include "bench/report/store.h"
#include "bench/study_scenes.h"

namespace lkao::bench {

struct Subject {
  Subject(const StudyScene& study_scene, float ao_radius);

  const StudyScene& scene;
  float radius;
  std::string name;  // scene and radius
  std::string key;   // for the store: another camera, size, or mesh that is seen, is another subject
};

// Rays of one falloff, in two halves that share no directions: what each half misses of the other tells how far the
// mean of both may be off.
struct Converged {
  std::vector<float> mean;  // of both halves
  PictureErrors between_halves;
  int ray_count = 0;  // of the mean
};

// What subjects are right against, by falloff: from the store, or cast and put there when first asked for.
class References {
 public:
  // 2 x `turn_count` times 1024 rays a pixel; twice as many of a falloff by which few of them count for much.
  References(PreparedScene& scene, const Subject& subject, int turn_count, const ReportStore& store)
      : scene_(scene), subject_(subject), turn_count_(turn_count), store_(store) {}

  const Converged& of(OwnFalloff falloff);

 private:
  std::vector<float> half(OwnFalloff falloff, int first_turn, int turn_count);

  PreparedScene& scene_;
  const Subject& subject_;
  int turn_count_;
  const ReportStore& store_;
  std::map<OwnFalloff, Converged> known_;
};

}  // namespace lkao::bench
