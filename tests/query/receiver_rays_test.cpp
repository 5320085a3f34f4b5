#include "query/receiver_rays.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "support/meshes.h"

namespace lkao {
namespace {

AmbientOcclusion query_with(const Jitter& jitter, std::uint64_t seed = 0) {
  return {OccluderBvh(tests::closed_box().view()),
          SamplePattern::standard(128).with_falloff(Falloff::linear()),
          {.radius = 3, .jitter = jitter, .seed = seed}};
}

TEST(ReceiverRays, AreThePatternTurnedToTheNormal) {
  const AmbientOcclusion ao = query_with({.rotation = 0, .tilt = 0});
  const ReceiverRays rays = ao.rays({.position = {1, 2, 3}, .normal = {0, 0, 1}}, 9);
  EXPECT_EQ(rays.ray_count, 128);
  EXPECT_EQ(rays.cast.count(), 128);
  for (std::size_t i = 0; i < 128; ++i) {
    const glm::vec3& pattern = ao.pattern().directions()[i];
    const glm::vec3 direction = rays.frame * pattern;
    EXPECT_EQ(direction.z, pattern.z);
    EXPECT_NEAR(glm::distance(rays.ray(static_cast<int>(i)), direction * ao.pattern().lengths()[i] * 3.0f), 0, 1e-6);
  }
}

TEST(ReceiverRays, StayAboveTheHorizonWhateverTheTilt) {
  lut::RandomStream random(61);
  const AmbientOcclusion ao = query_with({.rotation = 1, .tilt = std::numbers::pi_v<float> / 2});
  for (std::uint64_t index = 0; index < 2000; ++index) {
    const Receiver receiver{.position = {}, .normal = tests::random_direction(random)};
    const ReceiverRays rays = ao.rays(receiver, index);
    ASSERT_EQ(rays.cast.count(), rays.ray_count);
    for (int i = 0; i < rays.ray_count; ++i) {
      const glm::vec3 direction = rays.frame * ao.pattern().directions()[static_cast<std::size_t>(i)];
      ASSERT_GT(glm::dot(direction, receiver.normal), 0);
      ASSERT_NEAR(glm::length(direction), 1, 1e-5);
    }
  }
}

TEST(ReceiverRays, StayAboveTheGeometricHorizon) {
  lut::RandomStream random(62);
  const AmbientOcclusion ao = query_with({});
  int dropped_count = 0;
  for (std::uint64_t index = 0; index < 500; ++index) {
    const glm::vec3 geometric = tests::random_direction(random);
    const Receiver receiver{.position = {},
                            .normal = geometric + tests::random_direction(random) * 0.9f,
                            .geometric_normal = geometric * 2.0f};
    const ReceiverRays rays = ao.rays(receiver, index);
    for (int i = 0; i < rays.ray_count; ++i) {
      // Inside the closed box a ray that is not cast is not blocked either, and not counted.
      if (rays.cast.test(i)) {
        ASSERT_GE(glm::dot(glm::dvec3(rays.ray(i)), glm::dvec3(geometric)), -1e-7);
      }
      dropped_count += !rays.cast.test(i);
    }
    ASSERT_EQ(ao.query(receiver, index).mask & ~rays.cast, OcclusionMask());
  }
  EXPECT_GT(dropped_count, 1000);
}

TEST(ReceiverRays, DependOnSeedAndIndexAlone) {
  const Receiver receiver{.position = {0.1f, 0.2f, 0.3f}, .normal = {1, 2, 3}};
  const auto first_ray = [&](std::uint64_t seed, std::uint64_t index) {
    return query_with({}, seed).rays(receiver, index).ray(0);
  };
  EXPECT_EQ(first_ray(1, 2), first_ray(1, 2));
  EXPECT_NE(first_ray(1, 2), first_ray(1, 3));
  EXPECT_NE(first_ray(1, 2), first_ray(2, 2));
  EXPECT_NE(first_ray(1, 2), first_ray(2, 1)) << "seed and index must not be exchangeable";
}

// Rotations cover the turn evenly: the mean direction of one ray over many receivers is on the normal.
TEST(ReceiverRays, RotationsAreEven) {
  const AmbientOcclusion ao = query_with({});
  glm::dvec3 sum(0);
  constexpr int kCount = 20'000;
  for (std::uint64_t index = 0; index < kCount; ++index) {
    sum += glm::dvec3(ao.rays({.position = {}, .normal = {0, 0, 1}}, index).ray(5));
  }
  EXPECT_NEAR(sum.x / kCount, 0, 0.02);
  EXPECT_NEAR(sum.y / kCount, 0, 0.02);
}

TEST(ReceiverRays, OriginMovesOffTheSurfaceWithTheScale) {
  for (float scale : {1e-3f, 1.0f, 1e5f}) {
    tests::Mesh box = tests::closed_box();
    for (glm::vec3& p : box.positions) p *= scale;
    const OccluderBvh occluders(box.view());
    const AmbientOcclusion ao(occluders, SamplePattern::standard(64), {.radius = scale, .surface_offset = 64});
    const ReceiverRays rays = ao.rays({.position = {0, 0, 0}, .normal = {0, 0, 1}, .geometric_normal = {0, 2, 0}}, 0);
    EXPECT_EQ(rays.origin, glm::vec3(0, 64 * 0x1p-24f * scale, 0)) << scale;
  }
}

}  // namespace
}  // namespace lkao
