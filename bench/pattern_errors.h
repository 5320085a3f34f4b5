// Errors of sample patterns on a scene, against the integral with closest hits (Laine & Karras 2010, Eq. 2).
#pragma once

#include <string>
#include <vector>

#include "lkao/lkao.h"
#include "scene/mesh.h"

namespace lkao::bench {

// What is measured: a pattern, how it is turned from receiver to receiver, and a falloff.
struct PatternCase {
  PatternKind kind = PatternKind::lloyd;
  int ray_count = 128;
  Jitter jitter = {.rotation = 1, .tilt = 0};
};

struct PatternError {
  PatternCase what;
  std::string falloff;
  double rmse = 0;
  double bias = 0;  // mean of pattern - integral: negative is too little occlusion
  // Correlation of the errors of neighbouring pixels: 0 is noise, towards 1 neighbours err alike and bands show.
  double neighbour_correlation = 0;
  // RMSE that as many independent random rays would have.
  double independent_rmse = 0;
};

struct PatternStudyOptions {
  int reference_ray_count = 16384;
  int seed_count = 3;
};

// The falloffs of the study: those that have names, and one with steps.
std::vector<Falloff> study_falloffs();

// Of `receivers`, 2k and 2k + 1 are neighbouring pixels. In parallel; every case with every falloff, case by case.
std::vector<PatternError> measure_pattern_errors(const scene::Mesh& mesh, float radius,
                                                 const std::vector<Receiver>& receivers,
                                                 const std::vector<PatternCase>& cases,
                                                 const PatternStudyOptions& options);

}  // namespace lkao::bench
