// Boxes that hold next to nothing, exactly where a ray goes: none may be left out, whether for its distance, for lying
// below the horizon, for lying beside a ray or beside the cone of its neighbours.
//
// Each question has 64 receivers and needles at the world's origin, which a ray of each receiver passes through
// (pinned_receivers). Ray counts from 256 on have cones.
#include <vector>

#include <gtest/gtest.h>

#include "aimed_patterns.h"
#include "needles.h"
#include "ray_counts.h"
#include "same_bits.h"

namespace lkao::tests {
namespace {

class BoxCulls : public testing::TestWithParam<int> {
 protected:
  SamplePattern pattern() const { return SamplePattern::standard(GetParam()); }
  // At least so many of the 64 rays aimed at the needles must be blocked, or nothing was tested.
  void expect_found(const Mesh& mesh, const SamplePattern& pattern, const RayOptions& options, const Pin& pin,
                    std::uint64_t least) {
    const std::vector<Receiver> receivers = pinned_receivers(pattern, options, pin, random_);
    EXPECT_GE(expect_same_bits(mesh, pattern, options, receivers), least);
  }
  Mesh needles(float size, Touch touch, int decoy_count = 0) {
    Mesh mesh;
    add_needles(mesh, glm::vec3(0), size, touch, random_);
    add_decoys(mesh, decoy_count, 0.05f, 2.0f, random_);
    return mesh;
  }
  lut::RandomStream random_{1};
};

INSTANTIATE_TEST_SUITE_P(Rays, BoxCulls, ray_counts({64, 128, 192, 256, 1024}), testing::PrintToStringParamName());

// As far away as a ray goes, and a little nearer.
TEST_P(BoxCulls, KeepNeedlesAtTheEndsOfRays) {
  for (const float radius : {1.0f, 0.37f, 7e5f}) {
    for (const float share : {1.0f, 0.9999f, 0.98f, 0.92f}) {
      const float size = radius * (share == 1 ? 1e-9f : 1e-6f);
      for (const Touch touch : {Touch::inside, Touch::corner}) {
        expect_found(needles(size, touch), pattern(), {.radius = radius, .surface_offset = 0}, {.share = share}, 3);
      }
    }
  }
}

// Alone, and among others in a deep hierarchy.
TEST_P(BoxCulls, KeepNeedlesAnywhereOnRays) {
  for (const float share : {0.5f, 0x1p-4f, 0x1p-12f}) {
    for (const Touch touch : kAllTouches) {
      for (const float size : {1e-4f, 1e-7f, 1e-10f}) {
        const RayOptions options{.radius = 1, .surface_offset = 0};
        expect_found(needles(share * size, touch), pattern(), options, {.share = share}, 20);
      }
    }
    expect_found(needles(share * 1e-7f, Touch::inside, 200), pattern(), {.radius = 1, .surface_offset = 0},
                 {.share = share}, 30);
  }
}

TEST_P(BoxCulls, KeepNeedlesOnUnevenRaysOfTurnedPatterns) {
  const SamplePattern uneven = pattern().with_falloff(Falloff::linear());
  for (const Sidedness sidedness : {Sidedness::two_sided, Sidedness::one_sided}) {
    const RayOptions options{.radius = 3, .sidedness = sidedness, .jitter = {.tilt = 0.2f}, .surface_offset = 0};
    for (const float share : {1.0f, 0.5f}) {
      expect_found(needles(1e-8f, Touch::inside, 50), uneven, options, {.share = share}, 20);
    }
  }
}

// Hardly above it: what is culled lies below.
TEST_P(BoxCulls, KeepNeedlesAtTheHorizon) {
  for (const double elevation : {1e-7, 1e-6, 1e-4, 1e-2}) {
    for (const bool along_axes : {false, true}) {
      for (const Touch touch : kAllTouches) {
        expect_found(needles(1e-9f, touch), pattern(), {.radius = 1, .surface_offset = 0},
                     {.share = 0.5f, .along_axes = along_axes, .elevation = elevation}, 10);
      }
    }
  }
}

// Rays with components that are exactly 0 run within the planes of box faces.
TEST(BoxCullsOfAxes, KeepWhatARayTouchesInThePlaneOfAFace) {
  const SamplePattern cross = cross_pattern();
  const RayOptions options{.radius = 2, .jitter = {.rotation = 0}, .surface_offset = 0};
  lut::RandomStream random(2);
  for (int repetition = 0; repetition < 10; ++repetition) {
    for (const Touch touch : kAllTouches) {
      for (const float share : {1.0f, 0.5f, 0x1p-6f}) {
        Mesh mesh;
        add_needles(mesh, glm::vec3(0), repetition % 2 == 0 ? 1e-3f : 1e-9f, touch, random);
        const std::vector<Receiver> receivers =
            pinned_receivers(cross, options, {.share = share, .along_axes = true}, random);
        EXPECT_GT(expect_same_bits(mesh, cross, options, receivers), 5u);
      }
    }
  }
}

// What is out of reach of a batch is measured from where its rays start, which is off the surface: here farther than
// the rays are long.
TEST(BoxCullsOfBatches, MeasureFromTheOriginsOfRays) {
  lut::RandomStream random(3);
  const SamplePattern& pattern = SamplePattern::standard(64);
  std::uint64_t blocked_count = 0;
  for (const float surface_offset : {16.0f, 1000.0f}) {
    // Moves origins by 0.5.
    const glm::vec3 place = random_direction(random) * 0.5f * 0x1p24f / surface_offset;
    const RayOptions options{.radius = 0.25f, .surface_offset = surface_offset};
    for (int repetition = 0; repetition < 50; ++repetition) {
      Receiver receiver{.position = place + random_point(random, 1), .normal = random_direction(random)};
      const AmbientOcclusion nothing(OccluderBvh(TriangleMesh{}), pattern, options);
      const ReceiverRays rays = nothing.rays(receiver, 0);
      Mesh mesh;
      add_needles(mesh, rays.origin + uniform(random, 0.8f, 1.0f) * rays.ray(repetition), 0.05f, Touch::inside, random);
      blocked_count += expect_same_bits(mesh, pattern, options, {receiver});
    }
  }
  EXPECT_GT(blocked_count, 50u);
}

}  // namespace
}  // namespace lkao::tests
