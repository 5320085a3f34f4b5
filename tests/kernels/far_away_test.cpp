// Receivers far outside of the scene, and rays far longer than it or without an end.
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "aimed_patterns.h"
#include "needles.h"
#include "ray_counts.h"
#include "same_bits.h"

namespace lkao::tests::far_away_test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// In [-1, 1]^3: triangles of all sizes, a closed surface within them, and a wall behind.
Mesh mixed_scene(std::uint64_t seed) {
  Mesh mesh = random_soup(200, 0.05f, seed);
  const auto append = [&](const Mesh& part, float scale) {
    const auto first = static_cast<unsigned>(mesh.positions.size());
    for (const glm::vec3& p : part.positions) mesh.positions.push_back(scale * p);
    for (const glm::uvec3& t : part.triangles) mesh.triangles.push_back(t + first);
  };
  append(random_soup(10, 0.8f, seed + 1), 0.5f);
  append(closed_sphere(16, 8), 0.3f);
  add_quad(mesh, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0});
  return mesh;
}

class FarAway : public testing::TestWithParam<int> {
 protected:
  // Looking at the scene. Fewer where there are many rays, which find more.
  std::vector<Receiver> receivers_at(float distance) {
    const int count = 3 + 512 / GetParam();
    std::vector<Receiver> receivers;
    for (int i = 0; i < count; ++i) {
      const glm::vec3 direction = i % 4 == 0 ? random_axis(random_) : random_direction(random_);
      receivers.push_back({.position = distance * direction, .normal = -direction});
      if (i % 3 == 0) receivers.back().normal += (0.3f / distance) * random_direction(random_);
      if (i % 7 == 0) receivers.back().excluded_primitive = static_cast<std::uint32_t>(random_.next_below(200));
    }
    return receivers;
  }
  lut::RandomStream random_{41};
};

INSTANTIATE_TEST_SUITE_P(Rays, FarAway, ray_counts({64, 128, 256, 1024}), testing::PrintToStringParamName());

// With all rays on the scene.
TEST_P(FarAway, ReceiversSeeTheSceneThroughABeam) {
  const Mesh mesh = mixed_scene(42);
  for (const float distance : {2.0f, 10.0f, 1e3f, 1e6f}) {
    const SamplePattern pattern = beam(GetParam(), 1.0f / distance);
    for (const float beyond : {-0.5f, 0.2f, 2.0f, 1e3f * distance, kInfinity}) {
      for (const float surface_offset : {0.0f, 16.0f}) {
        const RayOptions options{.radius = distance + beyond,
                                 .sidedness = beyond > 2 ? Sidedness::one_sided : Sidedness::two_sided,
                                 .surface_offset = surface_offset};
        EXPECT_GT(expect_same_bits(mesh, pattern, options, receivers_at(distance)), 0u) << distance;
      }
    }
  }
}

TEST_P(FarAway, ReceiversSeeTheSceneWithFewRays) {
  const Mesh mesh = mixed_scene(43);
  for (const float distance : {2.0f, 10.0f, 1e3f, 1e6f}) {
    for (const float beyond : {0.3f, 10 * distance, kInfinity}) {
      const RayOptions options{.radius = distance + beyond};
      expect_same_bits(mesh, SamplePattern::standard(GetParam()), options, receivers_at(distance));
    }
  }
}

TEST_P(FarAway, ReceiversSeeLevels) {
  const OccluderBvh occluders(mixed_scene(44).view());
  for (const float distance : {2.0f, 10.0f, 1e3f}) {
    const SamplePattern pattern = beam(GetParam(), 1.0f / distance);
    const RayOptions options{.radius = distance + 2};
    const std::vector<Receiver> receivers = receivers_at(distance);
    EXPECT_GT(expect_scalar_bits({{{occluders, 0, distance}}, pattern, options, receivers}), 0u);
    EXPECT_GT(expect_scalar_bits({{{occluders, distance}}, pattern, options, receivers}), 0u);
    EXPECT_GT(expect_scalar_bits({{{occluders, distance - 0.2f, distance + 0.2f}}, pattern, options, receivers}), 0u);
  }
}

// The needles are as small as floats near 0 allow; the ray passes their middle exactly.
TEST_P(FarAway, ReceiversFindNeedles) {
  const SamplePattern& pattern = SamplePattern::standard(GetParam());
  for (const float radius : {1e6f, 1e12f}) {
    Mesh mesh;
    add_needles(mesh, glm::vec3(0), 1e-9f * radius, Touch::inside, random_);
    add_decoys(mesh, 50, 1e-7f * radius, 1e-6f * radius, random_);
    const RayOptions options{.radius = radius, .surface_offset = 0};
    const std::vector<Receiver> receivers = pinned_receivers(pattern, options, {.share = 0.5f}, random_);
    EXPECT_GE(expect_same_bits(mesh, pattern, options, receivers), 55u);
  }
}

// Receivers in the scene, near it and beyond it.
TEST_P(FarAway, EndsOfRaysChangeNothing) {
  const Mesh mesh = mixed_scene(45);
  const SamplePattern& pattern = SamplePattern::standard(GetParam());
  std::vector<Receiver> receivers;
  for (int i = 0; i < 8; ++i) {
    receivers.push_back({.position = random_point(random_, i < 6 ? 1.0f : 5.0f), .normal = random_direction(random_)});
  }
  // On a triangle, as in a renderer.
  for (std::uint32_t i = 0; i < 4; ++i) {
    receivers.push_back({.position = mesh.positions[3 * i], .normal = random_direction(random_)});
    receivers.back().excluded_primitive = i;
  }
  const float diagonal = 2 * std::sqrt(3.0f);
  std::uint64_t blocked_count = 0;
  for (const float radius : {2.0f, 100.0f, 1e6f, 1e12f, kInfinity}) {
    for (const Sidedness sidedness : {Sidedness::two_sided, Sidedness::one_sided}) {
      const RayOptions options{.radius = radius * diagonal, .sidedness = sidedness};
      blocked_count += expect_same_bits(mesh, pattern, options, receivers);
      // Shares of such rays are tiny.
      const OccluderBvh occluders(mesh.view());
      expect_scalar_bits({{{occluders, 0.2f, 1.5f}}, pattern, options, receivers});
      expect_scalar_bits({{{occluders, 0, 0.3f}, {occluders, 0.3f}}, pattern, options, receivers});
    }
  }
  EXPECT_GT(blocked_count, 1000u);
}

// A needle on every ray, each within a small part of its length.
TEST_P(FarAway, EndsOfRaysBehindNeedlesChangeNothing) {
  const SamplePattern& pattern = SamplePattern::standard(GetParam());
  for (const float radius : {10.0f, 1e3f, 1e6f}) {
    const RayOptions options{.radius = radius, .surface_offset = 0};
    const AmbientOcclusion nothing(OccluderBvh(TriangleMesh{}), pattern, options);
    const Receiver receiver{.position = random_point(random_, 1), .normal = random_direction(random_)};
    const ReceiverRays rays = nothing.rays(receiver, 0);
    Mesh mesh;
    for (int i = 0; i < rays.ray_count; ++i) {
      add_needles(mesh, rays.origin + uniform(random_, 0.1f, 2) / radius * rays.ray(i), 1e-4f, Touch::inside, random_);
    }
    EXPECT_GT(expect_same_bits(mesh, pattern, options, {receiver}), static_cast<std::uint64_t>(GetParam()) / 2);
  }
}

}  // namespace
}  // namespace lkao::tests::far_away_test
