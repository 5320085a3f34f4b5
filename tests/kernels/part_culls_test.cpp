// Levels of detail own parts of rays: what lies just within a part must be found, by whatever culls boxes that are too
// near or too far.
//
// Needles lie at the world's origin, where one ray of each receiver passes exactly (pinned_receivers); or one on every
// ray of a receiver.
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "needles.h"
#include "ray_counts.h"
#include "same_bits.h"

namespace lkao::tests::part_culls_test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

class PartCulls : public testing::TestWithParam<int> {
 protected:
  SamplePattern pattern() const { return SamplePattern::standard(GetParam()); }
  // 64 rays at needles at the distance `radius` / 2 from receivers, of which the distances in the range count.
  std::uint64_t ask(float radius, float r_min, float r_max, float size, int decoy_count) {
    const RayOptions options{.radius = radius, .surface_offset = 0};
    Mesh mesh;
    add_needles(mesh, glm::vec3(0), radius * size, Touch::inside, random_);
    add_decoys(mesh, decoy_count, 0.05f * radius, 2 * radius, random_);
    const std::vector<Receiver> receivers = pinned_receivers(pattern(), options, {.share = 0.5f}, random_);
    return expect_scalar_bits({{{OccluderBvh(mesh.view()), r_min, r_max}}, pattern(), options, receivers});
  }
  lut::RandomStream random_{11};
};

INSTANTIATE_TEST_SUITE_P(Rays, PartCulls, ray_counts({64, 192, 256, 1024}), testing::PrintToStringParamName());

TEST_P(PartCulls, KeepNeedlesWhereTheyBegin) {
  for (const float radius : {1.0f, 3e4f}) {
    for (const float size : {1e-6f, 1e-9f}) {
      // Begins exactly there; a little before; a lot.
      EXPECT_GT(ask(radius, 0.5f * radius, kInfinity, size, 0), 10u);
      for (const float share : {0.499999f, 0.4999f, 0.49f, 0.47f}) {
        EXPECT_GE(ask(radius, share * radius, kInfinity, size, 0), 55u);
      }
      EXPECT_GE(ask(radius, 0.499f * radius, kInfinity, size, 100), 55u);
    }
    EXPECT_EQ(ask(radius, 0.501f * radius, kInfinity, 1e-6f, 0), 0u);
  }
}

TEST_P(PartCulls, KeepNeedlesWhereTheyEnd) {
  for (const float radius : {1.0f, 3e4f}) {
    for (const float size : {1e-6f, 1e-9f}) {
      EXPECT_GT(ask(radius, 0, 0.5f * radius, size, 0), 10u);
      for (const float share : {0.500001f, 0.5001f, 0.505f, 0.53f}) {
        EXPECT_GE(ask(radius, 0.1f * radius, share * radius, size, 0), 55u);
      }
      EXPECT_GE(ask(radius, 0, 0.501f * radius, size, 100), 55u);
    }
    EXPECT_EQ(ask(radius, 0, 0.499f * radius, 1e-6f, 0), 0u);
  }
}

// A needle on every ray, at any share: shells of all distances, each a level of the same occluders.
TEST_P(PartCulls, LeaveNoGapBetweenLevels) {
  const SamplePattern uneven = pattern().with_falloff(Falloff::linear());
  const RayOptions options{.radius = 2, .surface_offset = 0};
  const AmbientOcclusion nothing(OccluderBvh(TriangleMesh{}), uneven, options);
  for (int repetition = 0; repetition < 3; ++repetition) {
    std::vector<Receiver> receivers{{.position = random_point(random_, 1), .normal = random_direction(random_)}};
    const ReceiverRays rays = nothing.rays(receivers[0], 0);
    Mesh mesh;
    for (int i = 0; i < rays.ray_count; ++i) {
      const glm::vec3 point = rays.origin + uniform(random_, 0.02f, 1) * rays.ray(i);
      add_needles(mesh, point, 1e-3f * glm::distance(point, rays.origin), Touch::inside, random_);
    }
    for (int i = 0; i < 5; ++i) {
      receivers.push_back({.position = random_point(random_, 1.5f), .normal = random_direction(random_)});
    }
    const OccluderBvh occluders(mesh.view());
    std::vector<OccluderLevel> levels;
    for (const float r : {0.0f, 0.2f, 0.4f, 0.5f, 0.9f, 1.3f}) levels.push_back({occluders, r, kInfinity});
    for (std::size_t i = 0; i + 1 < levels.size(); ++i) levels[i].r_max = levels[i + 1].r_min;
    const std::uint64_t blocked_count = expect_scalar_bits({levels, uneven, options, receivers});
    EXPECT_EQ(blocked_count, expect_same_bits(mesh, uneven, options, receivers));
    for (const OccluderLevel& level : levels) expect_scalar_bits({{level}, uneven, options, receivers});
  }
}

}  // namespace
}  // namespace lkao::tests::part_culls_test
