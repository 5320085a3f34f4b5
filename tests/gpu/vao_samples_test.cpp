// The sample sets of the VAO pass: spacing, rotations, order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>

#include "gpu/screen/vao/sample_sets.h"

namespace lkao::gl::tests::vao_samples_test {
namespace {

glm::dvec2 turn(const glm::dvec2& place, int ninths) {
  const double angle = ninths * 2 * std::numbers::pi / 9;
  return {place.x * std::cos(angle) - place.y * std::sin(angle), place.x * std::sin(angle) + place.y * std::cos(angle)};
}

std::vector<glm::dvec2> all_rotations(const std::vector<glm::dvec2>& places) {
  std::vector<glm::dvec2> all;
  for (int ninths = 0; ninths < kSampleRotationCount; ++ninths) {
    for (const glm::dvec2& place : places) all.push_back(turn(place, ninths));
  }
  return all;
}

double least_distance(const std::vector<glm::dvec2>& places) {
  double least = 10;
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) least = std::min(least, glm::distance(places[i], places[k]));
  }
  return least;
}

double sum_of_distances(const std::vector<glm::dvec2>& places) {
  double sum = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) sum += glm::distance(places[i], places[k]);
  }
  return sum;
}

// The largest sum of distances of all ways to turn the places from `i` on; `sum` is that of those before.
double best_sum(std::vector<glm::dvec2>& places, std::size_t i, double sum) {
  if (i == places.size()) return sum;
  const glm::dvec2 place = places[i];
  double best = 0;
  // Turning all of them alike changes nothing: the first stays.
  for (int ninths = 0; ninths < (i == 0 ? 1 : kSampleRotationCount); ++ninths) {
    places[i] = turn(place, ninths);
    double with = sum;
    for (std::size_t k = 0; k < i; ++k) with += glm::distance(places[i], places[k]);
    best = std::max(best, best_sum(places, i + 1, with));
  }
  places[i] = place;
  return best;
}

TEST(VaoSamples, RotationsStayApartAsMuchAsRandomDartsCan) {
  for (const int size : kSampleSetSizes) {
    SCOPED_TRACE(size);
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      const SampleSet set = make_sample_set(size, seed);
      ASSERT_EQ(std::ssize(set.places), size);
      EXPECT_GE(least_distance(all_rotations(set.places)), set.spacing * (1 - 1e-12));
      // Of the hexagonal lattice of as many points; random darts that fill the plane come to 0.7 to 0.8.
      const double hexagonal = std::sqrt(2 * std::numbers::pi / (std::numbers::sqrt3 * 9 * size));
      EXPECT_GT(set.spacing, 0.68 * hexagonal);
      for (const glm::dvec2& place : set.places) EXPECT_LE(glm::length(place), 1 - set.spacing / 3 + 1e-12);
    }
  }
}

TEST(VaoSamples, CoverTheDiscEvenly) {
  for (const int size : kSampleSetSizes) {
    SCOPED_TRACE(size);
    const SampleSet set = make_sample_set(size);
    double pipe = 0;
    for (const glm::dvec2& place : set.places) pipe += std::sqrt(1 - glm::dot(place, place)) / size;
    // Of the disc: 2/3 (Eqs. 1 and 2 agree).
    EXPECT_NEAR(pipe, 2.0 / 3, 0.04);
    // On either side of any line through the middle: half of what nine pixels look at.
    const std::vector<glm::dvec2> all = all_rotations(set.places);
    for (int i = 0; i < 36; ++i) {
      const glm::dvec2 side(std::cos(0.1 * i), std::sin(0.1 * i));
      const auto count = std::count_if(all.begin(), all.end(), [&](const glm::dvec2& p) { return dot(p, side) > 0; });
      EXPECT_NEAR(static_cast<double>(count) / static_cast<double>(all.size()), 0.5, 0.08);
    }
  }
}

TEST(VaoSamples, NoOtherTurnsOfSinglePlacesAreFartherApart) {
  for (const int size : {2, 4, 8}) {
    SampleSet set = make_sample_set(size);
    const double found = sum_of_distances(set.places);
    EXPECT_NEAR(best_sum(set.places, 0, 0), found, 1e-9) << size;
  }
  // Too many to try all: none of one place.
  for (const int size : {16, 32}) {
    const SampleSet set = make_sample_set(size);
    const double found = sum_of_distances(set.places);
    for (std::size_t i = 0; i < set.places.size(); ++i) {
      for (int ninths = 1; ninths < kSampleRotationCount; ++ninths) {
        std::vector<glm::dvec2> other = set.places;
        other[i] = turn(other[i], ninths);
        EXPECT_LE(sum_of_distances(other), found + 1e-6);
      }
    }
  }
}

TEST(VaoSamples, LieInZOrder) {
  const SampleSet set = make_sample_set(32);
  // Of the quarters of the disc: below left, below right, above left, above right.
  const auto quarter_of = [](const glm::dvec2& p) { return (p.x > 0 ? 1 : 0) + (p.y > 0 ? 2 : 0); };
  EXPECT_TRUE(std::is_sorted(set.places.begin(), set.places.end(),
                             [&](const glm::dvec2& a, const glm::dvec2& b) { return quarter_of(a) < quarter_of(b); }));
  // So that every fourth of them still lies in all quarters.
  std::vector<int> counts(4);
  for (std::size_t i = 0; i < set.places.size(); i += 4) ++counts[static_cast<std::size_t>(quarter_of(set.places[i]))];
  for (const int count : counts) EXPECT_GE(count, 1);
}

TEST(VaoSamples, AreAllInOneArray) {
  const auto& all = sample_sets();
  for (const int size : kSampleSetSizes) {
    const SampleSet set = make_sample_set(size);
    for (int i = 0; i < size; ++i) {
      EXPECT_EQ(all[static_cast<std::size_t>(size - 2 + i)], glm::vec2(set.places[static_cast<std::size_t>(i)]));
    }
  }
}

}  // namespace
}  // namespace lkao::gl::tests::vao_samples_test
