#include "lkao/plane_mask_table.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "lkao/isa.h"
#include "lut/plane_cells.h"
#include "lut/plane_mask_fill.h"
#include "lut/planes.h"
#include "support/meshes.h"
#include "support/sanitized.h"

namespace lkao {
namespace {

using lut::PlaneCell;
using tests::angle_between;
using tests::ends_of;
using tests::Plane;
using tests::turned;

lut::RayEnds ray_ends_of(const std::vector<glm::dvec3>& ends) {
  lut::RayEnds rays;
  rays.word_count = static_cast<int>(ends.size() / 64);
  for (const glm::vec3 end : ends) {
    rays.x.push_back(end.x), rays.y.push_back(end.y), rays.z.push_back(end.z);
    rays.length.push_back(glm::length(end));
  }
  return rays;
}

// Rays behind the last, which fill up a word, are beyond no plane: not even those through the receiver.
TEST(PlaneMaskTable, HasNoBitsBehindTheLastRay) {
  for (const int count : {1, 63, 65, 100}) {
    const SamplePattern pattern = SamplePattern::make(PatternKind::sobol, count);
    const int last = pattern.word_count() - 1;
    const std::uint64_t behind = ~(~std::uint64_t{0} >> (64 * pattern.word_count() - count));
    const PlaneMaskTable nearest(pattern, {.resolution = 32, .masks = PlaneMasks::nearest});
    const PlaneMaskTable bounds(pattern, {.resolution = 32, .masks = PlaneMasks::must_may});
    int all_count = 0;
    for (std::uint32_t cell = 0; cell < nearest.cell_count(); ++cell) {
      if (!nearest.cells().geometry(cell).is_used) continue;
      ASSERT_EQ(nearest.nearest(cell)[last] & behind, 0u) << count << ", " << cell;
      ASSERT_EQ(bounds.must(cell)[last] & behind, 0u) << count << ", " << cell;
      ASSERT_EQ(bounds.may(cell)[last] & behind, 0u) << count << ", " << cell;
      all_count += nearest.nearest(cell)[last] == ~behind;
    }
    EXPECT_GT(all_count, 0) << "the horizon is a plane that all rays are beyond";
  }
}

// One cell after another, made so that the bounds of one ray are within rounding of the cell's distances. Every plane
// of the cone counts here, and 1e-5 more, whether or not the cell fills its cone.
TEST(FillMustMay, BoundsTheWholeCone) {
  const std::vector<glm::dvec3> ends = ends_of(SamplePattern::standard(64).with_falloff(Falloff::linear()));
  const lut::RayEnds rays = ray_ends_of(ends);
  constexpr double kPromised = 1e-5;
  lut::RandomStream random(126);
  for (int i = 0; i < tests::unless_sanitized(500'000, 20'000); ++i) {
    const glm::dvec3 end = ends[random.next_below(ends.size())];
    const double aside = 2 * std::pow(10, -5 * random.next_double()),
                 angle = 0.6 * std::pow(10, -3 * random.next_double());
    const double slack = 1e-4 * (random.next_double() - 0.5);
    PlaneCell cell;
    cell.axis = turned(end, aside, random);
    cell.angle_cos = static_cast<float>(std::cos(angle)), cell.angle_sin = static_cast<float>(std::sin(angle));
    cell.nearest_distance = static_cast<float>(glm::length(end) * std::cos(std::max(aside - angle, 0.0)) + slack);
    cell.farthest_distance = static_cast<float>(glm::length(end) * std::cos(aside + angle) + slack);
    std::uint64_t must = 0, may = 0;
    lut::fill_must_may(rays, cell, &must, &may);
    for (std::size_t ray = 0; ray < ends.size(); ++ray) {
      const double length = glm::length(ends[ray]), phi = angle_between(cell.axis, ends[ray]);
      const double lowest = length * std::cos(phi + angle + kPromised);
      const double highest = length * std::cos(std::max(phi - angle - kPromised, 0.0));
      if ((must >> ray & 1) != 0) {
        ASSERT_GE(lowest, static_cast<double>(cell.farthest_distance) + kPromised) << i;
      }
      if ((may >> ray & 1) == 0) {
        ASSERT_LT(highest, static_cast<double>(cell.nearest_distance) - kPromised) << i;
      }
    }
  }
}

class Table : public testing::TestWithParam<std::tuple<PlaneAddressing, int, const char*>> {
 protected:
  SamplePattern pattern() const {
    return SamplePattern::standard(128).with_falloff(Falloff::named(std::get<2>(GetParam())));
  }
  PlaneMaskTable table(PlaneMasks masks) const {
    return PlaneMaskTable(pattern(), {std::get<1>(GetParam()), std::get<0>(GetParam()), masks});
  }
};

INSTANTIATE_TEST_SUITE_P(All, Table,
                         testing::Combine(testing::Values(PlaneAddressing::cube, PlaneAddressing::slices),
                                          testing::ValuesIn(tests::unless_sanitized<std::vector<int>>({32, 64, 128},
                                                                                                      {32, 64})),
                                          testing::Values("constant", "linear")));

// Half of the planes pass through the end of a ray: those are the ones that a bound too tight by rounding gets wrong.
// Of those, half are at nearly right angles to the ray.
Plane random_plane(const std::vector<glm::dvec3>& ends, lut::RandomStream& random) {
  Plane plane{tests::random_direction(random), tests::uniform(random, 0, 1)};
  if (random.next_below(2) == 0) return plane;
  const glm::dvec3 end = ends[random.next_below(ends.size())];
  if (random.next_below(2) == 0) plane.normal = turned(end, 0.1 * std::pow(random.next_double(), 4), random);
  plane.distance = static_cast<float>(glm::dot(glm::dvec3(plane.normal), end));
  if (plane.distance < 0) plane = {-plane.normal, -plane.distance};
  return plane;
}

// A plane through the receiver; half of them through the end of a ray.
Plane random_edge(const std::vector<glm::dvec3>& ends, lut::RandomStream& random) {
  const glm::vec3 normal = tests::random_direction(random);
  if (random.next_below(2) == 0) return {normal, 0};
  return {glm::normalize(glm::cross(glm::dvec3(normal), ends[random.next_below(ends.size())])), 0};
}

// must <= beyond <= may, for the plane itself and for one that is off by what the header allows.
testing::AssertionResult is_bounded(const PlaneMaskTable& table, std::uint32_t cell, const Plane& plane,
                                    const std::vector<glm::dvec3>& ends, lut::RandomStream& random) {
  const double d = plane.distance, off = random.next_below(2) == 0 ? 1e-5 : -1e-5;
  const glm::dvec3 normal = glm::normalize(glm::dvec3(plane.normal)), near_normal = turned(normal, 1e-5, random);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const bool must = (table.must(cell)[i / 64] >> (i % 64) & 1) != 0,
               may = (table.may(cell)[i / 64] >> (i % 64) & 1) != 0;
    for (const bool beyond : {glm::dot(normal, ends[i]) >= d, glm::dot(near_normal, ends[i]) >= d + off}) {
      if ((must && !beyond) || (beyond && !may)) {
        return testing::AssertionFailure() << "ray " << i << (must ? ": must" : ": not may") << ", normal " << normal.x
                                           << ' ' << normal.y << ' ' << normal.z << ", distance " << d;
      }
    }
  }
  return testing::AssertionSuccess();
}

TEST_P(Table, MustAndMayBoundMillionsOfPlanes) {
  const PlaneMaskTable table = this->table(PlaneMasks::must_may);
  const std::vector<glm::dvec3> ends = ends_of(pattern());
  lut::RandomStream random(122);
  for (int i = 0; i < tests::unless_sanitized(100'000, 5'000); ++i) {
    const Plane plane = random_plane(ends, random), edge = random_edge(ends, random);
    ASSERT_TRUE(is_bounded(table, table.cell(plane.normal, plane.distance), plane, ends, random)) << i;
    ASSERT_TRUE(is_bounded(table, table.edge_cell(edge.normal), edge, ends, random)) << i;
  }
}

// Bounds that left everything in doubt would be true as well.
TEST_P(Table, MustAndMayAreTight) {
  const PlaneMaskTable coarse(pattern(), {32, std::get<0>(GetParam()), PlaneMasks::must_may});
  const PlaneMaskTable table = this->table(PlaneMasks::must_may);
  lut::RandomStream random(123);
  int in_doubt = 0, coarse_in_doubt = 0;
  const auto doubt = [](const PlaneMaskTable& t, std::uint32_t cell) {
    return std::popcount(t.may(cell)[0] & ~t.must(cell)[0]) + std::popcount(t.may(cell)[1] & ~t.must(cell)[1]);
  };
  constexpr int kCount = tests::unless_sanitized(20'000, 4'000);
  for (int i = 0; i < kCount; ++i) {
    const glm::vec3 normal = tests::random_direction(random);
    const float distance = tests::uniform(random, 0, 1);
    in_doubt += doubt(table, table.cell(normal, distance)) + doubt(table, table.edge_cell(normal));
    coarse_in_doubt += doubt(coarse, coarse.cell(normal, distance)) + doubt(coarse, coarse.edge_cell(normal));
  }
  // A plane and an edge together leave about 26 of 256 rays open at resolution 32, and a quarter of that at 128.
  EXPECT_LT(coarse_in_doubt, 30 * kCount);
  EXPECT_LT(in_doubt * table.options().resolution, coarse_in_doubt * 38);
}

TEST_P(Table, NearestIsTheMaskOfTheMiddlePlane) {
  const PlaneMaskTable table = this->table(PlaneMasks::nearest);
  const SamplePattern pattern = this->pattern();
  lut::RandomStream random(124);
  for (int i = 0; i < tests::unless_sanitized(100'000, 5'000); ++i) {
    const glm::vec3 normal = tests::random_direction(random);
    const std::uint32_t cell = i % 2 == 0 ? table.edge_cell(normal) : table.cell(normal, tests::uniform(random, 0, 1));
    const PlaneCell geometry = table.cells().geometry(cell);
    std::uint64_t words[2] = {};
    for (std::size_t ray = 0; ray < 128; ++ray) {
      const glm::vec3 end = pattern.directions()[ray] * pattern.lengths()[ray];
      const float height = geometry.axis.x * end.x + geometry.axis.y * end.y + geometry.axis.z * end.z;
      words[ray / 64] |= std::uint64_t{height >= geometry.distance} << (ray % 64);
    }
    ASSERT_EQ(table.nearest(cell)[0], words[0]) << i;
    ASSERT_EQ(table.nearest(cell)[1], words[1]) << i;
  }
}

// Triangles that share an edge ask for n and -n: with complements they neither leave a gap nor overlap.
TEST_P(Table, OppositeEdgesAreComplements) {
  const PlaneMaskTable table = this->table(PlaneMasks::nearest);
  const std::vector<glm::dvec3> ends = ends_of(pattern());
  lut::RandomStream random(125);
  int other_cell_count = 0;
  constexpr int kCount = tests::unless_sanitized(200'000, 20'000);
  for (int i = 0; i < kCount; ++i) {
    const glm::vec3 normal = tests::random_direction(random);
    const std::uint32_t cell = table.edge_cell(normal), opposite = table.edge_cell(-normal);
    const glm::dvec3 axis = table.cells().geometry(cell).axis;
    if (glm::length(axis + glm::dvec3(table.cells().geometry(opposite).axis)) > 1e-6) {
      ++other_cell_count;  // the normal lies on a border of cells, and rounding fell to either side
      continue;
    }
    for (std::size_t ray = 0; ray < 128; ++ray) {
      if (std::fabs(glm::dot(axis, ends[ray])) < 1e-6) continue;  // on the middle plane: beyond both, maybe
      ASSERT_NE(table.nearest(cell)[ray / 64] >> (ray % 64) & 1, table.nearest(opposite)[ray / 64] >> (ray % 64) & 1);
    }
  }
  EXPECT_LE(other_cell_count, kCount / 10'000);
}

std::vector<std::uint64_t> all_words(const PlaneMaskTable& table) {
  std::vector<std::uint64_t> words;
  const int word_count = table.pattern().word_count();
  for (std::uint32_t cell = 0; cell < table.cell_count(); ++cell) {
    if (!table.cells().geometry(cell).is_used) continue;
    if (table.options().masks == PlaneMasks::nearest) {
      words.insert(words.end(), table.nearest(cell), table.nearest(cell) + word_count);
    } else {
      words.insert(words.end(), table.must(cell), table.must(cell) + word_count);
      words.insert(words.end(), table.may(cell), table.may(cell) + word_count);
    }
  }
  return words;
}

// Nearest and must/may with full-length and with shorter rays.
std::vector<std::uint64_t> words_of_some_tables(int thread_count = 0) {
  std::vector<std::uint64_t> words;
  for (const PlaneMasks masks : {PlaneMasks::nearest, PlaneMasks::must_may}) {
    const PlaneMaskTable table(SamplePattern::standard(192).with_falloff(Falloff::linear()),
                               {32, PlaneAddressing::slices, masks, thread_count});
    for (const PlaneMaskTable* part : {&table, &table.directions()}) {
      const std::vector<std::uint64_t> more = all_words(*part);
      words.insert(words.end(), more.begin(), more.end());
    }
  }
  return words;
}

TEST(PlaneMaskTable, EveryInstructionSetGivesTheSameBits) {
  const std::vector<std::uint64_t> best = words_of_some_tables();
  for (const std::string& isa : available_isas()) {
    force_isa(isa);
    EXPECT_EQ(words_of_some_tables(), best) << isa;
  }
  force_isa("");
}

TEST(PlaneMaskTable, AnyNumberOfThreadsGivesTheSameBits) {
  EXPECT_EQ(words_of_some_tables(1), words_of_some_tables(5));
}

TEST(PlaneMaskTable, DirectionsAreTheTableItselfWhereLengthsAreEqual) {
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32});
  EXPECT_EQ(&table.directions(), &table);
  const PlaneMaskTable copy = table;
  EXPECT_EQ(&copy.directions(), &copy);
  EXPECT_EQ(copy.must(0), table.must(0));  // shared
}

TEST(PlaneMaskTable, DirectionsAreRaysOfFullLength) {
  const SamplePattern& full = SamplePattern::standard(64);
  const PlaneMaskTable table(full.with_falloff(Falloff::smooth()), {.resolution = 32});
  ASSERT_NE(&table.directions(), &table);
  EXPECT_EQ(all_words(table.directions()), all_words(PlaneMaskTable(full, {.resolution = 32})));
}

TEST(PlaneMaskTable, CountsItsMemory) {
  const SamplePattern& full = SamplePattern::standard(192);
  const PlaneMaskTableOptions cube{.resolution = 32, .addressing = PlaneAddressing::cube, .masks = PlaneMasks::nearest};
  EXPECT_EQ(PlaneMaskTable(full, cube).memory_bytes(), 32u * 32 * 32 * 192 / 8);
  PlaneMaskTableOptions two_masks = cube;
  two_masks.masks = PlaneMasks::must_may;
  EXPECT_EQ(PlaneMaskTable(full, two_masks).memory_bytes(), 2 * 32u * 32 * 32 * 192 / 8);
  EXPECT_EQ(PlaneMaskTable(full.with_falloff(Falloff::linear()), two_masks).memory_bytes(),
            4 * 32u * 32 * 32 * 192 / 8);
  EXPECT_GT(PlaneMaskTable(full, cube).build_seconds(), 0);
}

TEST(PlaneMaskTable, RefusesResolutionsOutOfRange) {
  for (const int resolution : {-1, 0, 31, 257}) {
    try {
      PlaneMaskTable(SamplePattern::standard(64), {.resolution = resolution});
      ADD_FAILURE() << resolution << " was accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), testing::EndsWith("not " + std::to_string(resolution)));
    }
  }
}

TEST(PlaneMaskTable, RefusesANegativeNumberOfThreads) {
  EXPECT_THAT([] { PlaneMaskTable(SamplePattern::standard(64), {.thread_count = -1}); },
              testing::ThrowsMessage<std::invalid_argument>("thread_count must be at least 0, not -1"));
}

}  // namespace
}  // namespace lkao
