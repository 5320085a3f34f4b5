// Patterns of any number of rays: masks hold those rays and nothing behind them.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lkao/lkao.h"
#include "lkao/neighbourhood.h"
#include "support/brute_force.h"
#include "support/meshes.h"
#include "support/receivers.h"
#include "support/sanitized.h"

namespace lkao {
namespace {

std::vector<int> studied_counts() {
  std::vector<int> counts;
  for (int count = 1; count <= 200; count += tests::unless_sanitized(1, 27)) counts.push_back(count);
  counts.insert(counts.end(), {63, 65, 127, 129, 255, 256, 257, 511, 1023, 1024});
  if (!tests::kIsSanitized) counts.insert(counts.end(), {319, 321, 513, 577, 1000});
  return counts;
}

// Making them takes most of the time.
const SamplePattern& pattern_of(int ray_count) {
  static std::map<int, SamplePattern> patterns;
  const auto known = patterns.find(ray_count);
  if (known != patterns.end()) return known->second;
  return patterns.emplace(ray_count, SamplePattern::make(PatternKind::fibonacci, ray_count, Falloff::linear()))
      .first->second;
}

class RayCount : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { force_isa(GetParam()); }
  void TearDown() override { force_isa(""); }
};

INSTANTIATE_TEST_SUITE_P(All, RayCount, testing::ValuesIn(available_isas()), [](const auto& isa) { return isa.param; });

// Rays of the pattern alone are cast, all of them without geometric normals.
TEST(RayCountOfReceivers, IsThePatterns) {
  const OccluderBvh occluders(tests::closed_box().view());
  for (const int count : studied_counts()) {
    const AmbientOcclusion ao(occluders, pattern_of(count), {.radius = 0.1f});
    const ReceiverRays rays = ao.rays({.position = {0, 0, 0}, .normal = {1, 2, 3}}, 5);
    EXPECT_EQ(rays.ray_count, count);
    EXPECT_EQ(rays.cast.count(), count);
    EXPECT_TRUE(rays.cast.test(count - 1));
    for (int ray = count; ray < 64 * rays.word_count(); ++ray) ASSERT_EQ(rays.ray(ray), glm::vec3(0)) << count;
  }
}

// As every triangle tried, through every way to ask.
TEST_P(RayCount, OfAnyNumberIsTheBruteForce) {
  const tests::Mesh mesh = tests::random_soup(60, 0.6f, 201);
  const OccluderBvh occluders(mesh.view());
  const std::vector<Receiver> receivers = tests::with_exclusions(tests::random_receivers(8, 1, 202), 5);
  std::uint64_t blocked_count = 0;
  for (const int count : studied_counts()) {
    SCOPED_TRACE(fmt::format("{} rays", count));
    const SamplePattern& pattern = pattern_of(count);
    for (const float radius : {1.0f, std::numeric_limits<float>::infinity()}) {
      const RayOptions options{.radius = radius};
      const AmbientOcclusion simd(occluders, pattern, options), scalar(occluders, pattern, options, Kernel::scalar),
          levels({{occluders, 0, 0.3f}, {occluders, 0.3f}}, pattern, options);
      Neighbourhood around = simd.around({glm::vec3(-1), glm::vec3(1)});
      const auto words = static_cast<std::size_t>(pattern.word_count());
      std::vector<std::uint64_t> batch(receivers.size() * words);
      simd.query(receivers, {.mask_words = batch});
      for (std::size_t i = 0; i < receivers.size(); ++i) {
        const ReceiverRays rays = simd.rays(receivers[i], i);
        const OcclusionMask expected =
            tests::brute_force_mask(mesh.view(), rays, options, receivers[i].excluded_primitive);
        ASSERT_EQ(simd.query(receivers[i], i).mask, expected) << i;
        ASSERT_EQ(simd.blocked(receivers[i], i), expected) << i;
        ASSERT_EQ(scalar.query(receivers[i], i).mask, expected) << i;
        ASSERT_EQ(around.query(receivers[i], i).mask, expected) << i;
        ASSERT_TRUE(std::equal(expected.words, expected.words + words, &batch[i * words])) << i;
        const float share = static_cast<float>(expected.count()) / static_cast<float>(rays.cast.count());
        ASSERT_EQ(simd.query(receivers[i], i).occlusion, share) << i;
        if (receivers[i].excluded_primitive == kNoPrimitive) {
          ASSERT_EQ(levels.query(receivers[i], i).mask, expected) << i;
        }
        blocked_count += static_cast<std::uint64_t>(expected.count());
      }
    }
  }
  EXPECT_GT(blocked_count, 10'000u);
}

// In a room each thread remembers what blocked the rays of the receivers before, and asks that first.
TEST_P(RayCount, OfAnyNumberIsBlockedInAClosedRoom) {
  tests::Mesh mesh = tests::random_soup(3000, 0.05f, 203);
  const tests::Mesh box = tests::closed_box();
  for (const glm::uvec3& t : box.triangles) {
    mesh.triangles.push_back(t + glm::uvec3(static_cast<unsigned>(mesh.positions.size())));
  }
  mesh.positions.insert(mesh.positions.end(), box.positions.begin(), box.positions.end());
  const OccluderBvh occluders(mesh.view());
  const std::vector<Receiver> receivers = tests::random_receivers(200, 0.9f, 204);
  for (const int count : {1, 2, 15, 16, 17, 63, 65, 100, 129, 200, 1000}) {
    const AmbientOcclusion ao(occluders, pattern_of(count), {.radius = std::numeric_limits<float>::infinity()});
    // One after the other, in one thread.
    Neighbourhood around = ao.around({glm::vec3(-1), glm::vec3(1)});
    ReceiverRays rays;
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      ao.rays(receivers[i], i, rays);
      ASSERT_EQ(around.blocked(receivers[i], i), rays.cast) << count << " rays, receiver " << i;
    }
  }
}

TEST_P(RayCount, OfATableIsTheExactKernels) {
  const OccluderBvh occluders(tests::random_soup(300, 0.3f, 205).view());
  const std::vector<Receiver> receivers = tests::random_receivers(30, 1, 206);
  const std::vector<int> all{1, 3, 16, 48, 63, 65, 100, 127, 129, 200, 1000}, few{1, 63, 65, 200};
  for (const int count : tests::unless_sanitized(all, few)) {
    const SamplePattern& pattern = pattern_of(count);
    const RayOptions options{.radius = 0.8f};
    const AmbientOcclusion exact(occluders, pattern, options);
    for (const PlaneAddressing addressing : {PlaneAddressing::cube, PlaneAddressing::slices}) {
      const AmbientOcclusion by_table(occluders, PlaneMaskTable(pattern, {.resolution = 32, .addressing = addressing}),
                                      options);
      const AmbientOcclusion by_nearest(
          occluders,
          PlaneMaskTable(pattern, {.resolution = 32, .addressing = addressing, .masks = PlaneMasks::nearest}), options);
      for (std::size_t i = 0; i < receivers.size(); ++i) {
        ASSERT_EQ(by_table.query(receivers[i], i).mask, exact.query(receivers[i], i).mask) << count << " rays, " << i;
        ASSERT_FALSE((by_nearest.blocked(receivers[i], i) & ~exact.rays(receivers[i], i).cast).any()) << count;
      }
    }
  }
}

}  // namespace
}  // namespace lkao
