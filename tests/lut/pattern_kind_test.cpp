// The kinds of sample patterns, and what tells them apart.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "lkao/sample_pattern.h"
#include "lut/pattern_points.h"
#include "lut/random.h"
#include "support/sanitized.h"

namespace lkao {
namespace {

constexpr PatternKind kKinds[] = {PatternKind::lloyd, PatternKind::paper, PatternKind::fibonacci, PatternKind::sobol,
                                  PatternKind::random};

// Lloyd's relaxation takes long for many.
constexpr int kMostRays = tests::unless_sanitized(1024, 256);

TEST(PatternKind, HasAName) {
  for (PatternKind kind : kKinds) EXPECT_EQ(pattern_kind_named(pattern_kind_name(kind)), kind);
  try {
    pattern_kind_named("halton");
    FAIL() << "an unknown pattern was taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("halton"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("fibonacci"), std::string::npos) << error.what();
  }
  EXPECT_THROW(pattern_kind_name(static_cast<PatternKind>(99)), std::invalid_argument);
  EXPECT_THROW(SamplePattern::make(static_cast<PatternKind>(99), 64), std::invalid_argument);
  EXPECT_THROW(SamplePattern::make(PatternKind::sobol, 1025), std::invalid_argument);
}

TEST(PatternKind, MakesDirectionsAboveTheHorizonByTheSeedAlone) {
  for (PatternKind kind : kKinds) {
    for (int ray_count : {64, 192, kMostRays}) {
      const SamplePattern a = SamplePattern::make(kind, ray_count, Falloff::constant(), 3);
      const SamplePattern b = SamplePattern::make(kind, ray_count, Falloff::constant(), 3);
      const SamplePattern c = SamplePattern::make(kind, ray_count, Falloff::constant(), 4);
      EXPECT_EQ(a.ray_count(), ray_count);
      EXPECT_GT(a.lowest_elevation(), 0.0f);
      EXPECT_TRUE(std::equal(a.disk().begin(), a.disk().end(), b.disk().begin())) << pattern_kind_name(kind);
      EXPECT_FALSE(std::equal(a.disk().begin(), a.disk().end(), c.disk().begin())) << pattern_kind_name(kind);
    }
  }
}

// Rounding must not put a point on the edge of the disk, where its direction would lie in the horizon.
TEST(PatternKind, StaysInsideTheDiskForManySeeds) {
  for (std::uint64_t seed = 0; seed < tests::unless_sanitized(100u, 10u); ++seed) {
    for (PatternKind kind : {PatternKind::sobol, PatternKind::random}) {
      EXPECT_NO_THROW(SamplePattern::make(kind, 1024, Falloff::constant(), seed));
    }
  }
}

glm::dvec2 disk_to_square(const glm::dvec2& p) {
  const double radius = glm::length(p);
  if (std::abs(p.x) > std::abs(p.y)) {
    const double a = std::copysign(radius, p.x);
    return {(a + 1) / 2, (a * std::atan(p.y / p.x) * 4 / std::numbers::pi + 1) / 2};
  }
  const double b = std::copysign(radius, p.y);
  return {(b * std::atan(p.x / p.y) * 4 / std::numbers::pi + 1) / 2, (b + 1) / 2};
}

// A (0, m, 2)-net: every box of area 1/N with sides that are powers of two holds one point, and scrambling keeps that.
TEST(PatternKind, SobolIsANet) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const std::vector<glm::dvec2> points = lut::sobol_points(256, seed);
    for (int split = 0; split <= 8; ++split) {
      std::set<std::pair<int, int>> boxes;
      for (const glm::dvec2& p : points) {
        const glm::dvec2 square = disk_to_square(p);
        boxes.emplace(static_cast<int>(square.x * (1 << split)), static_cast<int>(square.y * (256 >> split)));
      }
      EXPECT_EQ(boxes.size(), 256u) << "boxes 1/" << (1 << split) << " wide";
    }
  }
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// What the paper's recipe does when it is taken literally: centroids lie inside their cells, so the lowest ray is far
// from the horizon, where the lowest of N rays is due at sin^2 = 1 / (2 N).
TEST(PatternKind, PaperLeavesTheHorizonEmpty) {
  for (int ray_count : {64, 128, kMostRays}) {
    std::vector<double> paper, standard;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      for (auto [kind, lowest] : {std::pair{PatternKind::paper, &paper}, std::pair{PatternKind::lloyd, &standard}}) {
        const SamplePattern pattern = SamplePattern::make(kind, ray_count, Falloff::constant(), seed);
        const double sine = std::sin(static_cast<double>(pattern.lowest_elevation()));
        lowest->push_back(sine * sine * 2 * ray_count);
      }
    }
    EXPECT_NEAR(mean(standard), 1.0, 1e-3) << ray_count;
    EXPECT_GT(mean(paper), 9.0) << ray_count;
  }
}

// RMSE over occluders that fill a half-space, whose occlusion is known: walls at some distance, as seen with an AO
// radius of 1, and slopes that pass through the receiver. They face every way, as under random rotation.
double half_space_error(const SamplePattern& pattern) {
  lut::RandomStream random(3);
  constexpr int kPairCount = 500;
  double sum2 = 0;
  for (int i = 0; i < kPairCount; ++i) {
    const double turn = random.next_double() * 2 * std::numbers::pi;
    const double x = std::cos(turn), y = std::sin(turn);
    const double h = random.next_double(), up = random.next_double() * 2 - 1, side = std::sqrt(1 - up * up);
    int wall_count = 0, slope_count = 0;
    for (const glm::dvec3 d : pattern.directions()) {
      wall_count += d.x * x + d.y * y > h;
      slope_count += (d.x * x + d.y * y) * side + d.z * up > 0;
    }
    const double wall = (std::acos(h) - h * std::sqrt(1 - h * h)) / std::numbers::pi, slope = (1 + up) / 2;
    sum2 += std::pow(static_cast<double>(wall_count) / pattern.ray_count() - wall, 2);
    sum2 += std::pow(static_cast<double>(slope_count) / pattern.ray_count() - slope, 2);
  }
  return std::sqrt(sum2 / (2 * kPairCount));
}

double half_space_error(PatternKind kind, int ray_count) {
  std::vector<double> errors;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    errors.push_back(half_space_error(SamplePattern::make(kind, ray_count, Falloff::constant(), seed)));
  }
  return mean(errors);
}

TEST(PatternKind, DefaultBeatsSobolOnHalfSpaces) {
  for (int ray_count : {64, 128, kMostRays}) {
    const double standard = half_space_error(PatternKind::lloyd, ray_count);
    const double sobol = half_space_error(PatternKind::sobol, ray_count);
    EXPECT_LT(standard, 0.85 * sobol) << ray_count;
    EXPECT_LT(sobol, half_space_error(PatternKind::paper, ray_count)) << ray_count;
    EXPECT_LT(standard, 1.02 * half_space_error(PatternKind::fibonacci, ray_count)) << ray_count;
  }
}

}  // namespace
}  // namespace lkao
