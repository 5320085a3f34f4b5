// Patterns, falloffs and tables through C are those of C++.
#include <algorithm>
#include <array>
#include <cstring>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "c_api/owned.h"
#include "lkao/c.h"
#include "lkao/lkao.h"

namespace lkao {
namespace {

using tests::made;
using tests::OwnedPattern;
using tests::OwnedTable;

void expect_equal(const lkao_pattern* actual, const SamplePattern& expected) {
  const auto count = static_cast<std::size_t>(expected.ray_count());
  ASSERT_EQ(lkao_pattern_ray_count(actual), expected.ray_count());
  EXPECT_EQ(lkao_pattern_word_count(actual), expected.word_count());
  EXPECT_EQ(std::memcmp(lkao_pattern_disk(actual), expected.disk().data(), count * sizeof(glm::vec2)), 0);
  EXPECT_EQ(std::memcmp(lkao_pattern_directions(actual), expected.directions().data(), count * sizeof(glm::vec3)), 0);
  EXPECT_EQ(std::memcmp(lkao_pattern_lengths(actual), expected.lengths().data(), count * sizeof(float)), 0);
  float elevation = 0;
  EXPECT_EQ(lkao_pattern_lowest_elevation(actual, &elevation), LKAO_OK);
  EXPECT_EQ(elevation, expected.lowest_elevation());
}

OwnedPattern make(const lkao_pattern_options& options) { return made<OwnedPattern>(lkao_pattern_create, &options); }

TEST(CPattern, KindsAreThoseOfCpp) {
  const std::pair<lkao_pattern_kind, PatternKind> kinds[] = {{LKAO_PATTERN_LLOYD, PatternKind::lloyd},
                                                             {LKAO_PATTERN_PAPER, PatternKind::paper},
                                                             {LKAO_PATTERN_FIBONACCI, PatternKind::fibonacci},
                                                             {LKAO_PATTERN_SOBOL, PatternKind::sobol},
                                                             {LKAO_PATTERN_RANDOM, PatternKind::random}};
  for (const auto& [number, kind] : kinds) {
    lkao_pattern_options options = LKAO_PATTERN_OPTIONS_INIT;
    options.kind = number, options.ray_count = 37, options.seed = 5;
    expect_equal(make(options).get(), SamplePattern::make(kind, 37, Falloff::constant(), 5));
    options.weighting = LKAO_UNIFORM;
    expect_equal(make(options).get(), SamplePattern::make(kind, 37, Falloff::constant(), 5, Weighting::uniform));
    EXPECT_STREQ(lkao_pattern_kind_name(number), pattern_kind_name(kind));
    lkao_pattern_kind named = -1;
    EXPECT_EQ(lkao_pattern_kind_named(pattern_kind_name(kind), &named), LKAO_OK);
    EXPECT_EQ(named, number);
  }
  EXPECT_EQ(lkao_pattern_kind_name(5), nullptr);
}

double square(void* user, double x) {
  ++*static_cast<int*>(user);
  return 1 - x * x;
}

TEST(CPattern, FalloffsAreThoseOfCpp) {
  int call_count = 0;
  lkao_falloff falloff = LKAO_FALLOFF_INIT;
  falloff.rate = 3, falloff.function = square, falloff.user = &call_count;
  const std::pair<lkao_falloff_kind, Falloff> kinds[] = {
      {LKAO_FALLOFF_CONSTANT, Falloff::constant()},
      {LKAO_FALLOFF_LINEAR, Falloff::linear()},
      {LKAO_FALLOFF_SMOOTH, Falloff::smooth()},
      {LKAO_FALLOFF_EXPONENTIAL, Falloff::exponential(3)},
      {LKAO_FALLOFF_CUSTOM, Falloff::custom("square", [](double x) { return 1 - x * x; })}};
  const OwnedPattern plain = tests::c_pattern(48);
  for (const auto& [number, expected] : kinds) {
    falloff.kind = number;
    double value = -1;
    EXPECT_EQ(lkao_falloff_value(&falloff, 0.3, &value), LKAO_OK);
    EXPECT_EQ(value, expected(0.3));
    EXPECT_EQ(lkao_falloff_length_at(&falloff, 0.3, &value), LKAO_OK);
    EXPECT_EQ(value, expected.length_at(0.3));
    lkao_pattern_options options = LKAO_PATTERN_OPTIONS_INIT;
    options.ray_count = 48, options.falloff = &falloff;
    expect_equal(make(options).get(), SamplePattern::relaxed(48, expected));
    expect_equal(made<OwnedPattern>(lkao_pattern_create_with_falloff, plain.get(), &falloff).get(),
                 SamplePattern::standard(48).with_falloff(expected));
    lkao_falloff_kind named = -1;
    EXPECT_EQ(lkao_falloff_kind_named(lkao_falloff_kind_name(number), &named), LKAO_OK);
    EXPECT_EQ(named, number);
  }
  EXPECT_GT(call_count, 4096);
}

TEST(CPattern, OfTheCallersOwnPointsInAnyLayout) {
  struct OwnRay {
    char before;
    float x, y, length;
  };
  const std::array<OwnRay, 3> points{{{'a', 0.1f, 0.2f, 1}, {'b', -0.5f, 0.3f, 0.5f}, {'c', 0, -0.9f, 0.25f}}};
  const OwnedPattern pattern = made<OwnedPattern>(lkao_pattern_create_from_disk, &points[0].x, sizeof(OwnRay),
                                                  &points[0].length, sizeof(OwnRay), 3);
  const std::vector<glm::vec2> disk{{0.1f, 0.2f}, {-0.5f, 0.3f}, {0, -0.9f}};
  const std::vector<float> lengths{1, 0.5f, 0.25f};
  expect_equal(pattern.get(), SamplePattern::from_disk(disk, lengths));
  expect_equal(
      made<OwnedPattern>(lkao_pattern_create_from_disk, &disk[0].x, std::size_t{0}, lengths.data(), std::size_t{0}, 3)
          .get(),
      SamplePattern::from_disk(disk, lengths));
}

void expect_same_cells(const lkao_table* actual, const PlaneMaskTable& expected) {
  const glm::vec3 normals[] = {{0, 0, 1}, {0.6f, 0, 0.8f}, {0, -1, 0}, {0.6f, 0.64f, -0.48f}};
  const std::size_t word_count = static_cast<std::size_t>(expected.pattern().word_count());
  const bool is_nearest = expected.options().masks == PlaneMasks::nearest;
  for (const glm::vec3& n : normals) {
    for (const float d : {0.0f, 0.3f, 2.0f}) {
      std::uint32_t cell = 0;
      ASSERT_EQ(lkao_table_cell(actual, &n.x, d, &cell), LKAO_OK) << lkao_last_error();
      ASSERT_EQ(cell, expected.cell(n, d));
      if (is_nearest) {
        EXPECT_TRUE(
            std::equal(expected.nearest(cell), expected.nearest(cell) + word_count, lkao_table_nearest(actual, cell)));
      } else {
        EXPECT_TRUE(std::equal(expected.must(cell), expected.must(cell) + word_count, lkao_table_must(actual, cell)));
        EXPECT_TRUE(std::equal(expected.may(cell), expected.may(cell) + word_count, lkao_table_may(actual, cell)));
      }
    }
    std::uint32_t edge_cell = 0;
    ASSERT_EQ(lkao_table_edge_cell(actual, &n.x, &edge_cell), LKAO_OK);
    EXPECT_EQ(edge_cell, expected.edge_cell(n));
  }
  EXPECT_EQ(lkao_table_nearest(actual, 0) != nullptr, is_nearest);
  EXPECT_EQ(lkao_table_must(actual, 0) != nullptr, !is_nearest);
}

TEST(CTable, IsThatOfCpp) {
  lkao_pattern_options with_lengths = LKAO_PATTERN_OPTIONS_INIT;
  lkao_falloff linear = LKAO_FALLOFF_INIT;
  linear.kind = LKAO_FALLOFF_LINEAR;
  with_lengths.ray_count = 70, with_lengths.falloff = &linear;
  const OwnedPattern pattern = make(with_lengths);
  const std::pair<lkao_plane_addressing, PlaneAddressing> addressings[] = {
      {LKAO_ADDRESSING_CUBE, PlaneAddressing::cube}, {LKAO_ADDRESSING_SLICES, PlaneAddressing::slices}};
  const std::pair<lkao_plane_masks, PlaneMasks> masks[] = {{LKAO_MASKS_NEAREST, PlaneMasks::nearest},
                                                           {LKAO_MASKS_MUST_MAY, PlaneMasks::must_may}};
  for (const auto& [addressing, cpp_addressing] : addressings) {
    for (const auto& [mask, cpp_mask] : masks) {
      lkao_table_options options = LKAO_TABLE_OPTIONS_INIT;
      options.resolution = 32, options.addressing = addressing, options.masks = mask, options.thread_count = 2;
      const OwnedTable table = made<OwnedTable>(lkao_table_create, pattern.get(), &options);
      const PlaneMaskTable expected(SamplePattern::relaxed(70, Falloff::linear()),
                                    {.resolution = 32, .addressing = cpp_addressing, .masks = cpp_mask});
      expect_same_cells(table.get(), expected);
      expect_same_cells(made<OwnedTable>(lkao_table_create_directions, table.get()).get(), expected.directions());
      expect_equal(made<OwnedPattern>(lkao_pattern_create_of_table, table.get()).get(), expected.pattern());

      lkao_table_options back = LKAO_TABLE_OPTIONS_INIT;
      EXPECT_EQ(lkao_table_get_options(table.get(), &back), LKAO_OK);
      EXPECT_EQ(back.resolution, 32);
      EXPECT_EQ(back.addressing, addressing);
      EXPECT_EQ(back.masks, mask);
      EXPECT_EQ(back.thread_count, 2);
      lkao_table_report report = LKAO_TABLE_REPORT_INIT;
      EXPECT_EQ(lkao_table_get_report(table.get(), &report), LKAO_OK);
      EXPECT_EQ(report.cell_count, expected.cell_count());
      EXPECT_EQ(report.memory_bytes, expected.memory_bytes());
      EXPECT_GT(report.build_seconds, 0);
    }
  }
}

TEST(CIsa, IsThatOfCpp) {
  const std::vector<std::string> names = available_isas();
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(lkao_available_isa(i), names[i]);
  EXPECT_EQ(lkao_available_isa(names.size()), nullptr);
  EXPECT_EQ(lkao_active_isa(), active_isa());
  EXPECT_EQ(lkao_force_isa(names.back().c_str()), LKAO_OK);
  EXPECT_EQ(active_isa(), names.back());
  EXPECT_EQ(lkao_force_isa("mmx"), LKAO_ERROR_INVALID_ARGUMENT);
  EXPECT_THAT(lkao_last_error(), testing::StartsWith("lkao_force_isa: unknown instruction set mmx"));
  EXPECT_EQ(lkao_force_isa(nullptr), LKAO_OK);
  EXPECT_EQ(active_isa(), names.front());
}

}  // namespace
}  // namespace lkao
