// Ways to spread the directions of a sample pattern.
#pragma once

#include "lkao/requirements.h"

namespace lkao {

// How directions are spread. Lengths are dealt to all kinds alike; what differs is the error at a ray count, and, for
// `paper`, a bias. Figures are of real scenes, relative to `sobol` (lut/README.md).
enum class PatternKind {
  // The default: Lloyd-relaxed, radii at equal areas, balanced over half-spaces. Irregular from neighbour to
  // neighbour. RMSE 0.8.
  lloyd,
  // The recipe of the paper, literally: random points, 60 Lloyd steps, each point replaced by a random one of its
  // Voronoi cell, 3 steps more. Leaves the horizon empty, so occlusion is too low. RMSE 1.4 (64 rays) to 4 (1024).
  paper,
  // Fibonacci spiral: regular; the seed only turns it. RMSE 0.8.
  fibonacci,
  // The two-dimensional Sobol sequence with Owen's scrambling, mapped to the disk. RMSE 1.
  sobol,
  // Independent directions. RMSE 2 (64 rays) to 4.6 (1024).
  random,
};

}  // namespace lkao
