#include "lut/pattern_recipes.h"

#include <stdexcept>

#include <fmt/format.h>

#include "lut/disk_relaxation.h"
#include "lut/pattern_balance.h"
#include "lut/pattern_points.h"
#include "lut/random.h"

namespace lkao::lut {
namespace {

// Laine & Karras 2010, Sec. 6, name "a large number" and "a few" steps.
constexpr int kFirstStepCount = 60;
constexpr int kSecondStepCount = 3;

// How far the default's points are scattered, as a share of the paper's: the knob between the spiral's order (0) and
// disorder (1). The largest that keeps the RMSE at 1024 rays safely below 0.8 of Sobol's (lut/README.md).
constexpr double kScatterShare = 0.3;

std::vector<glm::dvec2> paper_points(int point_count, RandomStream random) {
  std::vector<glm::dvec2> points = random_points(point_count, random.next_bits());
  relax(points, kFirstStepCount);
  scatter(points, 1.0, random.next_bits());
  relax(points, kSecondStepCount);
  return points;
}

// Differs from the paper: it starts from a spiral, whose large-scale density is even, not from random points, which
// relaxation leaves uneven; it scatters less; after each step it puts back what centroids, which lie inside their
// cells, pull away from the horizon; and in the end it balances half-spaces.
std::vector<glm::dvec2> balanced_points(int point_count, RandomStream random, Weighting weighting) {
  std::vector<glm::dvec2> points = spiral_points(point_count, random.next_bits());
  scatter(points, kScatterShare, random.next_bits());
  for (int step = 0; step < kSecondStepCount; ++step) {
    relax(points, 1);
    restore_equal_areas(points);
  }
  balance(points, random.next_bits(), weighting);
  return points;
}

}  // namespace

std::vector<glm::dvec2> pattern_points(PatternKind kind, int point_count, std::uint64_t seed, Weighting weighting) {
  switch (kind) {
    case PatternKind::lloyd:
      return balanced_points(point_count, RandomStream(seed), weighting);
    case PatternKind::paper:
      return paper_points(point_count, RandomStream(seed));
    case PatternKind::fibonacci:
      return spiral_points(point_count, seed);
    case PatternKind::sobol:
      return sobol_points(point_count, seed);
    case PatternKind::random:
      return random_points(point_count, seed);
  }
  throw std::invalid_argument(fmt::format("pattern kind {} does not exist", static_cast<int>(kind)));
}

}  // namespace lkao::lut
