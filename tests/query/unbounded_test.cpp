// An infinite AO radius: rays that go beyond all occluders.
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "lkao/lkao.h"
#include "support/brute_force.h"
#include "support/kernel_choice.h"
#include "support/meshes.h"
#include "support/receivers.h"
#include "support/sanitized.h"

namespace lkao::unbounded_test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

class Unbounded : public tests::OnEveryKernel {
 protected:
  RayOptions options(float radius = kInfinity) const { return {.radius = radius}; }
};

INSTANTIATE_TEST_SUITE_P(Kernels, Unbounded, testing::ValuesIn(tests::all_kernels()), tests::name_of_choice);

// Within the scene, at its rim, and so far away that it is a dot or less.
std::vector<Receiver> near_and_far_receivers() {
  std::vector<Receiver> receivers = tests::random_receivers(tests::unless_sanitized(40, 8), 1, 71);
  lut::RandomStream random(72);
  for (const float distance : {2.0f, 20.0f, 1e4f, 1e9f, 5e17f}) {
    for (int i = 0; i < tests::unless_sanitized(10, 3); ++i) {
      const glm::vec3 from = tests::random_direction(random);
      receivers.push_back({.position = distance * from, .normal = -from + 0.5f * tests::random_direction(random)});
    }
  }
  return receivers;
}

TEST_P(Unbounded, TriesEveryTriangleAtAnyDistance) {
  const tests::Mesh mesh = tests::random_soup(500, 0.3f, 73);
  const OccluderBvh occluders(mesh.view());
  const std::vector<Receiver> receivers = near_and_far_receivers();
  for (const int ray_count : {64, 128, 1024}) {
    const AmbientOcclusion ao(occluders, SamplePattern::standard(ray_count), options(), GetParam().kernel);
    const auto words = static_cast<std::size_t>(ao.pattern().word_count());
    std::vector<std::uint64_t> batch(receivers.size() * words);
    ao.query(receivers, {.mask_words = batch});
    int blocked_count = 0;
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      const OcclusionMask expected = tests::brute_force_mask(mesh.view(), ao.rays(receivers[i], i), ao.options());
      ASSERT_EQ(ao.query(receivers[i], i).mask, expected) << ray_count << " rays, receiver " << i;
      for (std::size_t w = 0; w < words; ++w) ASSERT_EQ(batch[i * words + w], expected.words[w]) << i;
      blocked_count += expected.count();
    }
    EXPECT_GT(blocked_count, ray_count);
  }
}

// Powers of two change no digit of a ray, so that the masks are the same bit for bit.
TEST_P(Unbounded, IsAsARadiusBeyondTheScene) {
  const OccluderBvh occluders(tests::random_soup(2000, 0.1f, 74).view());
  const std::vector<Receiver> receivers = tests::random_receivers(60, 1, 75);
  const AmbientOcclusion unbounded(occluders, SamplePattern::standard(128), options(), GetParam().kernel);
  for (const float radius : {0x1p3f, 0x1p10f, 0x1p30f}) {
    const AmbientOcclusion bounded(occluders, SamplePattern::standard(128), options(radius), GetParam().kernel);
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      ASSERT_EQ(unbounded.query(receivers[i], i).mask, bounded.query(receivers[i], i).mask) << radius << ", " << i;
    }
  }
}

TEST_P(Unbounded, ClosedBoxBlocksAllAndNothingBlocksNone) {
  const AmbientOcclusion box(OccluderBvh(tests::closed_box().view()), SamplePattern::standard(1024), options(),
                             GetParam().kernel);
  const AmbientOcclusion nothing(OccluderBvh(TriangleMesh{}), SamplePattern::standard(64), options(),
                                 GetParam().kernel);
  for (const Receiver& receiver : tests::random_receivers(50, 0.99f, 76)) {
    EXPECT_EQ(box.query(receiver, 1).occlusion, 1);
    EXPECT_EQ(nothing.query(receiver, 1).occlusion, 0);
  }
}

// A share of infinity is infinite, but for none of it.
TEST_P(Unbounded, RaysOfAnyLengthOfAFalloffReachEverything) {
  const SamplePattern& standard = SamplePattern::standard(64);
  std::vector<float> lengths(64, 0.001f);
  lengths[5] = 0;
  const AmbientOcclusion ao(OccluderBvh(tests::closed_box().view()), SamplePattern::from_disk(standard.disk(), lengths),
                            options(), GetParam().kernel);
  const OcclusionMask mask = ao.query({.position = {0.5f, 0, 0}, .normal = {0, 1, 0}}, 3).mask;
  EXPECT_EQ(mask.count(), 63);
  EXPECT_FALSE(mask.test(5));
}

TEST_P(Unbounded, LevelsOfTheSameOccludersGiveTheBitsOfNone) {
  const OccluderBvh occluders(tests::random_soup(1000, 0.2f, 77).view());
  const std::vector<OccluderLevel> levels = {{occluders, 0, 0.4f}, {occluders, 0.4f, 1.5f}, {occluders, 1.5f}};
  const AmbientOcclusion whole(occluders, SamplePattern::standard(256), options(), GetParam().kernel);
  const AmbientOcclusion parts(levels, SamplePattern::standard(256), options(), GetParam().kernel);
  const std::vector<Receiver> receivers = near_and_far_receivers();
  std::vector<float> batch(receivers.size());
  parts.query(receivers, {.occlusion = batch});
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const ReceiverOcclusion expected = whole.query(receivers[i], i);
    ASSERT_EQ(parts.query(receivers[i], i).mask, expected.mask) << i;
    ASSERT_EQ(batch[i], expected.occlusion) << i;
  }
}

TEST(UnboundedRays, GoBeyondAllOccludersAndAreExactMultiplesOfDirections) {
  const OccluderBvh occluders(tests::random_soup(100, 0.1f, 78).view());
  const AmbientOcclusion ao(occluders, SamplePattern::standard(64), {.radius = kInfinity});
  for (const Receiver& receiver : near_and_far_receivers()) {
    const ReceiverRays rays = ao.rays(receiver, 0);
    const glm::dvec3 origin(rays.origin);
    double farthest = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Bounds& box = occluders.bounds();
      const glm::dvec3 point(corner & 1 ? box.upper.x : box.lower.x, corner & 2 ? box.upper.y : box.lower.y,
                             corner & 4 ? box.upper.z : box.lower.z);
      farthest = std::max(farthest, glm::distance(origin, point));
    }
    int exponent = 0;
    EXPECT_EQ(std::frexp(rays.radius, &exponent), 0.5f);
    for (int i = 0; i < 64; ++i) EXPECT_GT(glm::length(glm::dvec3(rays.ray(i))), farthest);
    EXPECT_LT(rays.radius, 2.1 * farthest);
  }
}

TEST(UnboundedTables, GiveTheBitsOfTheDefinition) {
  const tests::Mesh mesh = tests::random_soup(300, 0.3f, 79);
  const SamplePattern& pattern = SamplePattern::standard(64);
  const AmbientOcclusion ao(OccluderBvh(mesh.view()), PlaneMaskTable(pattern, {.masks = PlaneMasks::must_may}),
                            {.radius = kInfinity});
  const std::vector<Receiver> receivers = tests::random_receivers(40, 1, 80);
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const OcclusionMask expected = tests::brute_force_mask(mesh.view(), ao.rays(receivers[i], i), ao.options());
    ASSERT_EQ(ao.query(receivers[i], i).mask, expected) << i;
  }
}

TEST(UnboundedTables, RefuseRaysOfSeveralLengths) {
  const SamplePattern pattern = SamplePattern::standard(64).with_falloff(Falloff::linear());
  const OccluderBvh occluders(tests::closed_box().view());
  const PlaneMaskTable table(pattern, {.resolution = 32});
  EXPECT_THROW(AmbientOcclusion(occluders, table, {.radius = kInfinity}), std::invalid_argument);
  EXPECT_NO_THROW(AmbientOcclusion(occluders, table, {.radius = 1e6f}));
}

}  // namespace
}  // namespace lkao::unbounded_test
