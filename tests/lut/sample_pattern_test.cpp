#include "lkao/sample_pattern.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "lut/random.h"
#include "support/sanitized.h"

namespace lkao {
namespace {

class SamplePatternOfCount : public testing::TestWithParam<int> {
 protected:
  const SamplePattern& pattern() const { return SamplePattern::standard(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(Counts, SamplePatternOfCount,
                         testing::ValuesIn(tests::unless_sanitized<std::vector<int>>(
                             {48, 64, 100, 128, 192, 200, 512, 1000, 1024}, {48, 64, 100, 192, 200})));

TEST(SamplePattern, TakesCountsFrom1To1024) {
  for (int count : {-64, -1, 0, 1025, 1088, 1 << 30}) {
    EXPECT_FALSE(is_valid_ray_count(count));
    EXPECT_THROW(SamplePattern::relaxed(count), std::invalid_argument) << count;
    EXPECT_THROW(SamplePattern::standard(count), std::invalid_argument) << count;
  }
  for (int count = 1; count <= 1024; ++count) {
    EXPECT_TRUE(is_valid_ray_count(count));
    EXPECT_EQ(SamplePattern::make(PatternKind::sobol, count).ray_count(), count);
    EXPECT_EQ(word_count_of(count), (count - 1) / 64 + 1);
  }
  EXPECT_EQ(SamplePattern::standard(1).word_count(), 1);
  EXPECT_THROW(SamplePattern::from_disk({}, {}), std::invalid_argument);
}

TEST(SamplePattern, NamesWhatIsWrong) {
  std::vector<glm::vec2> points(64, glm::vec2(0.5f, 0.0f));
  std::vector<float> lengths(64, 1.0f);
  EXPECT_NO_THROW(SamplePattern::from_disk(points, lengths));
  points[7] = {0.8f, 0.6001f};
  try {
    SamplePattern::from_disk(points, lengths);
    FAIL() << "a point outside the disk was taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("point 7"), std::string::npos) << error.what();
  }
  points[7] = {std::numeric_limits<float>::quiet_NaN(), 0};
  EXPECT_THROW(SamplePattern::from_disk(points, lengths), std::invalid_argument);
  points[7] = {0, 0};
  for (float bad : {-0.1f, 1.1f, std::numeric_limits<float>::quiet_NaN()}) {
    lengths[9] = bad;
    EXPECT_THROW(SamplePattern::from_disk(points, lengths), std::invalid_argument) << bad;
  }
  lengths.resize(63);
  EXPECT_THROW(SamplePattern::from_disk(points, lengths), std::invalid_argument);
}

TEST(SamplePattern, DependsOnTheSeedAlone) {
  const SamplePattern a = SamplePattern::relaxed(128, Falloff::constant(), 5);
  const SamplePattern b = SamplePattern::relaxed(128, Falloff::constant(), 5);
  const SamplePattern c = SamplePattern::relaxed(128, Falloff::constant(), 6);
  EXPECT_TRUE(std::equal(a.disk().begin(), a.disk().end(), b.disk().begin()));
  EXPECT_FALSE(std::equal(a.disk().begin(), a.disk().end(), c.disk().begin()));
}

TEST_P(SamplePatternOfCount, IsMadeOnceAndIsTheRelaxedOne) {
  EXPECT_EQ(&SamplePattern::standard(GetParam()), &SamplePattern::standard(GetParam()));
  const SamplePattern again = SamplePattern::relaxed(GetParam());
  EXPECT_TRUE(std::equal(again.disk().begin(), again.disk().end(), pattern().disk().begin()));
  EXPECT_EQ(pattern().ray_count(), GetParam());
  EXPECT_EQ(pattern().word_count(), (GetParam() + 63) / 64);
}

TEST_P(SamplePatternOfCount, HasUnitDirectionsAboveTheHorizon) {
  float lowest = 1;
  for (const glm::vec3& d : pattern().directions()) {
    EXPECT_NEAR(glm::length(d), 1.0f, 1e-6f);
    lowest = std::min(lowest, d.z);
  }
  EXPECT_GT(lowest, 0.0f);
  EXPECT_NEAR(pattern().lowest_elevation(), std::asin(lowest), 1e-6f);
}

// Cosine weighting: the squared sine of the elevation is uniform, so the k-th lowest is known exactly. This is the
// boundary bias of plain Lloyd relaxation, which leaves no ray near the horizon.
TEST_P(SamplePatternOfCount, HasExactElevations) {
  std::vector<double> z2;
  for (const glm::vec3& d : pattern().directions()) z2.push_back(static_cast<double>(d.z) * d.z);
  std::sort(z2.begin(), z2.end());
  for (std::size_t k = 0; k < z2.size(); ++k) {
    EXPECT_NEAR(z2[k], (static_cast<double>(k) + 0.5) / static_cast<double>(z2.size()), 1e-6);
  }
}

// Uniform weighting: the height itself is uniform (Archimedes). In the lowest rows of the hemisphere, float's steps on
// the disk are some 1e-7 of a square.
TEST_P(SamplePatternOfCount, HasExactHeightsWhereTheWeightingIsUniform) {
  std::vector<double> z;
  for (const glm::vec3& d : SamplePattern::standard(GetParam(), Weighting::uniform).directions()) {
    EXPECT_NEAR(glm::length(d), 1.0f, 1e-6f);
    z.push_back(static_cast<double>(d.z));
  }
  std::sort(z.begin(), z.end());
  for (std::size_t k = 0; k < z.size(); ++k) {
    const double due = (static_cast<double>(k) + 0.5) / static_cast<double>(z.size());
    EXPECT_NEAR(z[k] * z[k], due * due, 2.5e-6) << k;
  }
  EXPECT_GT(z.front(), 0);
}

// Of the hemisphere's heights; one ray has the middle of them, which is not their mean.
TEST(SamplePattern, HasTheMeanHeightOfItsWeighting) {
  for (const PatternKind kind : {PatternKind::lloyd, PatternKind::fibonacci, PatternKind::sobol, PatternKind::random}) {
    for (const auto& [weighting, mean] : {std::pair(Weighting::cosine, 2.0 / 3), std::pair(Weighting::uniform, 0.5)}) {
      const SamplePattern pattern = SamplePattern::make(kind, 1000, Falloff::constant(), 1, weighting);
      double sum = 0;
      for (const glm::vec3& d : pattern.directions()) sum += static_cast<double>(d.z);
      EXPECT_NEAR(sum / 1000, mean, kind == PatternKind::random ? 0.03 : 1e-3) << pattern_kind_name(kind);
    }
  }
  EXPECT_NEAR(SamplePattern::standard(1, Weighting::uniform).directions()[0].z, 0.5, 1e-6);
  EXPECT_NE(&SamplePattern::standard(64, Weighting::uniform), &SamplePattern::standard(64));
  EXPECT_EQ(&SamplePattern::standard(64, Weighting::uniform), &SamplePattern::standard(64, Weighting::uniform));
  EXPECT_THROW(SamplePattern::standard(64, static_cast<Weighting>(7)), std::invalid_argument);
}

// Any half disk holds half of the points, to a few points: walls darken evenly whatever way they face. Random points
// miss by sqrt(N) / 2.
TEST_P(SamplePatternOfCount, SharesEveryHalfDisk) {
  const double n = GetParam();
  double sum2 = 0;
  constexpr int kTurns = 360;
  for (int turn = 0; turn < kTurns; ++turn) {
    const double angle = turn * 2.0 * std::numbers::pi / kTurns;
    int count = 0;
    for (const glm::vec2& p : pattern().disk()) count += p.x * std::cos(angle) + p.y * std::sin(angle) > 0;
    sum2 += (count - 0.5 * n) * (count - 0.5 * n);
  }
  EXPECT_LT(std::sqrt(sum2 / kTurns), 0.12 * std::sqrt(n));
}

// Blue noise: no two points close together. Hexagonal packing has the largest possible least distance.
TEST_P(SamplePatternOfCount, KeepsPointsApart) {
  const auto disk = pattern().disk();
  float least = 4;
  for (std::size_t i = 0; i < disk.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, glm::distance(disk[i], disk[j]));
  }
  const double hexagonal = std::sqrt(2.0 * std::numbers::pi / (std::sqrt(3.0) * GetParam()));
  EXPECT_GT(least, 0.35 * hexagonal);
}

// How much the distances to the nearest neighbour vary, as a share of their mean.
double irregularity(const SamplePattern& pattern) {
  const auto disk = pattern.disk();
  double sum = 0, sum2 = 0;
  for (std::size_t i = 0; i < disk.size(); ++i) {
    double nearest = 4;
    for (std::size_t j = 0; j < disk.size(); ++j) {
      if (j != i) nearest = std::min(nearest, static_cast<double>(glm::distance(disk[i], disk[j])));
    }
    sum += nearest, sum2 += nearest * nearest;
  }
  const double mean = sum / pattern.ray_count();
  return std::sqrt(sum2 / pattern.ray_count() - mean * mean) / mean;
}

// Not the regular spiral it started from: the scattering must have left its mark.
TEST_P(SamplePatternOfCount, IsIrregular) {
  const SamplePattern spiral = SamplePattern::make(PatternKind::fibonacci, GetParam());
  EXPECT_GT(irregularity(pattern()), 2 * irregularity(spiral));
}

TEST_P(SamplePatternOfCount, PutsNeighboursOnNeighbouringBits) {
  const auto disk = pattern().disk();
  double path = 0;
  for (std::size_t i = 1; i < disk.size(); ++i) path += glm::distance(disk[i], disk[i - 1]);
  const double mean_step = path / (GetParam() - 1);
  EXPECT_LT(mean_step, 1.6 * std::sqrt(std::numbers::pi / GetParam()));
}

// P(length >= x) = rho(x), to one ray.
TEST_P(SamplePatternOfCount, DistributesLengthsAfterTheFalloff) {
  for (const Falloff& falloff : {Falloff::constant(), Falloff::linear(), Falloff::smooth(), Falloff::exponential(3)}) {
    const SamplePattern with_lengths = pattern().with_falloff(falloff);
    for (int place = 1; place < 100; ++place) {
      const double x = place / 100.0;
      const auto longer = std::count_if(with_lengths.lengths().begin(), with_lengths.lengths().end(),
                                        [&](float length) { return length >= x; });
      EXPECT_NEAR(static_cast<double>(longer) / GetParam(), falloff(x), 1.0 / GetParam()) << falloff.name() << x;
    }
    EXPECT_TRUE(std::equal(pattern().disk().begin(), pattern().disk().end(), with_lengths.disk().begin()));
  }
}

// Any 16 neighbours on the curve have short and long rays: their mean varies less than that of random lengths, whose
// standard deviation is 1 / sqrt(12 x 16) = 0.072.
TEST_P(SamplePatternOfCount, MixesLengthsAmongNeighbours) {
  const SamplePattern linear = pattern().with_falloff(Falloff::linear());
  double sum2 = 0;
  int group_count = 0;
  for (int first = 0; first + 16 <= GetParam(); ++first, ++group_count) {
    double sum = 0;
    for (int i = 0; i < 16; ++i) sum += static_cast<double>(linear.lengths()[static_cast<std::size_t>(first + i)]);
    sum2 += (sum / 16 - 0.5) * (sum / 16 - 0.5);
  }
  EXPECT_LT(std::sqrt(sum2 / group_count), 0.055);
}

// A level ceiling at height h cares for elevation and length alone, which no turn of the pattern evens out. With linear
// falloff its occlusion is (1 - h)^2; uniformly weighted, the integral of 1 - h / z over the heights z from h to 1.
// Lengths dealt at random miss by 0.019 with 128 rays and 0.0072 with 1024.
double ceiling_error(const SamplePattern& linear, Weighting weighting) {
  double sum2 = 0;
  constexpr int kHeightCount = 98;
  for (int place = 0; place < kHeightCount; ++place) {
    const double h = 0.02 + 0.01 * place;
    int blocked_count = 0;
    for (std::size_t i = 0; i < linear.lengths().size(); ++i) {
      blocked_count += static_cast<double>(linear.lengths()[i] * linear.directions()[i].z) >= h;
    }
    const double due = weighting == Weighting::cosine ? (1 - h) * (1 - h) : 1 - h + h * std::log(h);
    const double error = static_cast<double>(blocked_count) / linear.ray_count() - due;
    sum2 += error * error;
  }
  return std::sqrt(sum2 / kHeightCount);
}

TEST_P(SamplePatternOfCount, StratifiesLengthsAgainstElevation) {
  for (const Weighting weighting : {Weighting::cosine, Weighting::uniform}) {
    const SamplePattern linear = SamplePattern::standard(GetParam(), weighting).with_falloff(Falloff::linear());
    EXPECT_LT(ceiling_error(linear, weighting), 0.5 * std::pow(GetParam(), -0.75));
  }
}

// RMS difference between the rays in a half disk that are longer than some length, and those due.
double half_disk_length_error(const SamplePattern& linear) {
  double sum2 = 0;
  constexpr int kTurns = 60, kPlaces = 9;
  for (int turn = 0; turn < kTurns; ++turn) {
    const double angle = turn * 2.0 * std::numbers::pi / kTurns;
    for (int place = 1; place <= kPlaces; ++place) {
      const double length = place / 10.0;
      int count = 0;
      for (std::size_t i = 0; i < linear.lengths().size(); ++i) {
        const glm::vec2& p = linear.disk()[i];
        count += p.x * std::cos(angle) + p.y * std::sin(angle) > 0 && static_cast<double>(linear.lengths()[i]) > length;
      }
      const double error = static_cast<double>(count) / linear.ray_count() - 0.5 * (1 - length);
      sum2 += error * error;
    }
  }
  return std::sqrt(sum2 / (kTurns * kPlaces));
}

TEST_P(SamplePatternOfCount, StratifiesLengthsAgainstDirections) {
  const SamplePattern linear = pattern().with_falloff(Falloff::linear());
  lut::RandomStream random(1);
  std::vector<float> shuffled(linear.lengths().begin(), linear.lengths().end());
  for (std::size_t left = shuffled.size(); left > 1; --left) {
    std::swap(shuffled[left - 1], shuffled[random.next_below(left)]);
  }
  EXPECT_LT(half_disk_length_error(linear),
            0.6 * half_disk_length_error(SamplePattern::from_disk(linear.disk(), shuffled)));
}

// One ray, halfway: as much weight lies above as below.
TEST(SamplePattern, OfOneRayPointsHalfwayUp) {
  EXPECT_NEAR(SamplePattern::standard(1).directions()[0].z, std::sqrt(0.5), 1e-6);
  EXPECT_EQ(SamplePattern::standard(1).with_falloff(Falloff::linear()).lengths()[0], 0.5f);
}

// Root mean square, over walls of all heights and sides, of the difference between the share of rays that they block
// and the share that is due.
double wall_error(const SamplePattern& pattern, Weighting weighting) {
  double sum2 = 0;
  constexpr int kHeights = 20, kTurns = 90;
  for (int height = 1; height < kHeights; ++height) {
    // From the foot of an infinite wall its upper edge is seen at this angle above the horizon.
    const double angle = std::numbers::pi * height / kHeights;
    const double due = weighting == Weighting::cosine ? 0.5 * (1 - std::cos(angle)) : angle / std::numbers::pi;
    for (int turn = 0; turn < kTurns; ++turn) {
      const double side = 2 * std::numbers::pi * (turn + 0.37) / kTurns;
      const glm::vec3 beyond(std::sin(angle) * std::cos(side), std::sin(angle) * std::sin(side), -std::cos(angle));
      int count = 0;
      for (const glm::vec3& direction : pattern.directions()) count += glm::dot(direction, beyond) > 0;
      const double error = static_cast<double>(count) / pattern.ray_count() - due;
      sum2 += error * error;
    }
  }
  return std::sqrt(sum2 / ((kHeights - 1) * kTurns));
}

// No count is worse than those below it: by how much a kind's chance may blur that, of three patterns each.
void expect_falling_errors(Weighting weighting) {
  for (const auto& [kind, most] : {std::pair(PatternKind::lloyd, 1.05), std::pair(PatternKind::fibonacci, 1.05),
                                   std::pair(PatternKind::paper, 1.25), std::pair(PatternKind::sobol, 1.15),
                                   std::pair(PatternKind::random, 1.15)}) {
    double last = 1;
    for (int count = 1; count <= tests::unless_sanitized(130, 20); ++count) {
      double sum2 = 0;
      for (std::uint64_t seed = 0; seed < 3; ++seed) {
        const double error =
            wall_error(SamplePattern::make(kind, count, Falloff::constant(), seed, weighting), weighting);
        sum2 += error * error;
      }
      const double error = std::sqrt(sum2 / 3);
      EXPECT_LT(error, most * last) << pattern_kind_name(kind) << ", " << count << " rays";
      if (kind == PatternKind::lloyd) {
        EXPECT_LT(error, 0.42 * std::pow(count, -0.75)) << count << " rays";
      }
      last = error;
    }
  }
}
TEST(SamplePattern, ErrsLessTheMoreRaysThereAre) { expect_falling_errors(Weighting::cosine); }
TEST(SamplePattern, ErrsLessTheMoreRaysThereAreWhereTheWeightingIsUniform) {
  expect_falling_errors(Weighting::uniform);
}

// The same rays are the long ones whatever the falloff, and whoever asks first.
TEST(SamplePattern, DealsLengthsByDirectionsAlone) {
  const SamplePattern a = SamplePattern::standard(128).with_falloff(Falloff::linear());
  const SamplePattern b =
      SamplePattern::relaxed(128).with_falloff(Falloff::exponential()).with_falloff(Falloff::linear());
  const SamplePattern c =
      SamplePattern::from_disk(a.disk(), std::vector<float>(128, 0.5f)).with_falloff(Falloff::linear());
  EXPECT_TRUE(std::equal(a.lengths().begin(), a.lengths().end(), b.lengths().begin()));
  EXPECT_TRUE(std::equal(a.lengths().begin(), a.lengths().end(), c.lengths().begin()));
  const SamplePattern steep = a.with_falloff(Falloff::exponential(9));
  for (std::size_t i = 1; i < 128; ++i) {
    EXPECT_EQ(a.lengths()[i] < a.lengths()[i - 1], steep.lengths()[i] < steep.lengths()[i - 1]) << i;
  }
}

}  // namespace
}  // namespace lkao
