// What share of a light is seen: where that is known in closed form, and at the ends of the range.
#include "lkao/soft_shadows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <glm/geometric.hpp>

#include "lkao/ray_bundles.h"
#include "support/instances.h"
#include "support/kernel_choice.h"
#include "support/meshes.h"
#include "support/receivers.h"

namespace lkao {
namespace {

using tests::Mesh;

constexpr Receiver kFloor{.position = {0, 0, 0}, .normal = {0, 1, 0}};

Mesh quad(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
  Mesh mesh;
  tests::add_quad(mesh, corner, u, v);
  return mesh;
}

SoftShadows shadows_of(const Mesh& mesh, const AreaLight& light, int ray_count = 256) {
  return {OccluderBvh(mesh.view()), light, SamplePattern::standard(ray_count)};
}

// Mean over many turns of the light's points: what is left is bias, not noise.
double mean_visibility(const Mesh& mesh, const AreaLight& light, const Receiver& receiver, int ray_count = 256) {
  const SoftShadows shadows = shadows_of(mesh, light, ray_count);
  const std::vector<Receiver> receivers(200, receiver);
  std::vector<float> visibility(receivers.size());
  EXPECT_EQ(shadows.query(receivers, {.visibility = visibility}).invalid_receiver_count, 0u);
  double sum = 0;
  for (const float value : visibility) sum += static_cast<double>(value);
  return sum / static_cast<double>(visibility.size());
}

const AreaLight kLights[] = {DiscLight{{0, 2, 0}, {0, -1, 0}, 0.5f}, SphereLight{{0, 2, 0}, 0.5f}};

TEST(SoftShadows, OpenIsOneAndCoveredIsZero) {
  const Mesh floor = quad({-50, 0, -50}, {0, 0, 100}, {100, 0, 0}), cover = quad({-5, 1, -5}, {0, 0, 10}, {10, 0, 0});
  for (const AreaLight& light : kLights) {
    EXPECT_EQ(mean_visibility({}, light, kFloor), 1.0);
    EXPECT_EQ(mean_visibility(floor, light, kFloor), 1.0);
    EXPECT_EQ(mean_visibility(cover, light, kFloor), 0.0);
  }
}

TEST(SoftShadows, OccludersBehindTheLightHideNothing) {
  const Mesh behind = quad({-5, 2.6f, -5}, {0, 0, 10}, {10, 0, 0});
  for (const AreaLight& light : kLights) EXPECT_EQ(mean_visibility(behind, light, kFloor), 1.0);
}

// A half-plane at half the height of a disc, its edge above x = 0: from the floor at x its edge is seen at -x in the
// plane of the disc, so the penumbra is as wide as the disc and ends on both sides of the edge.
TEST(SoftShadows, PenumbraOfAHalfPlane) {
  const Mesh half = quad({-100, 1, -100}, {0, 0, 200}, {100, 0, 0});
  for (const float x : {-0.6f, -0.4f, -0.2f, 0.0f, 0.1f, 0.3f, 0.45f, 0.6f}) {
    const double t = std::clamp(-static_cast<double>(x) / 0.5, -1.0, 1.0);
    const double expected = (std::acos(t) - t * std::sqrt(1 - t * t)) / std::numbers::pi;
    EXPECT_NEAR(mean_visibility(half, kLights[0], {.position = {x, 0, 0}, .normal = {0, 1, 0}}), expected, 2e-3) << x;
  }
}

Mesh coaxial_disk(float radius) {
  Mesh mesh;
  constexpr int kCorners = 720;
  mesh.positions.emplace_back(0, 1, 0);
  for (int i = 0; i < kCorners; ++i) {
    const float turn = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kCorners;
    mesh.positions.emplace_back(radius * std::cos(turn), 1, radius * std::sin(turn));
  }
  for (unsigned i = 0; i < kCorners; ++i) mesh.triangles.emplace_back(0, 1 + i, 1 + (i + 1) % kCorners);
  return mesh;
}

// An eclipse: a disk at height 1 leaves a ring of a light at height 2, by area of a disc, by solid angle of a sphere.
TEST(SoftShadows, EclipseByACoaxialDisk) {
  const double sphere_cosine = std::sqrt(1 - 0.25 * 0.25);
  for (const float radius : {0.05f, 0.1f, 0.2f, 0.24f, 0.27f}) {
    const double a = radius, disk_cosine = 1 / std::sqrt(1 + a * a);
    const double of_disc = std::max(0.0, 1 - 4 * a * a / 0.25);
    const double of_sphere = std::max(0.0, 1 - (1 - disk_cosine) / (1 - sphere_cosine));
    EXPECT_NEAR(mean_visibility(coaxial_disk(radius), kLights[0], kFloor, 1024), of_disc, 3e-3) << radius;
    EXPECT_NEAR(mean_visibility(coaxial_disk(radius), kLights[1], kFloor, 1024), of_sphere, 3e-3) << radius;
  }
}

// What of the light is below the horizon is not seen, and no ray goes there.
TEST(SoftShadows, TheHorizonCutsTheLight) {
  const Receiver sideways{.position = {0, 0, 0}, .normal = {1, 0, 0}};
  for (const AreaLight& light : kLights) {
    const SoftShadows shadows = shadows_of({}, light, 1024);
    EXPECT_NEAR(mean_visibility({}, light, sideways), 0.5, 2e-3);
    const LightVisibility half = shadows.query(sideways, 0);
    EXPECT_EQ(half.visibility, half.above_horizon);
    EXPECT_NEAR(half.above_horizon, 0.5f, 0.02f);

    Receiver away = kFloor;
    away.normal = {0, -1, 0};
    std::vector<float> visibility(1, 7), above(1, 7);
    const std::vector<Receiver> receivers = {away};
    const QueryReport report = shadows.query(receivers, {visibility, above});
    EXPECT_EQ(report.invalid_receiver_count + report.ray_count, 0u);
    EXPECT_EQ(visibility[0], 0.0f);
    EXPECT_EQ(above[0], 0.0f);
    // The side of the surface decides, not the shading normal.
    away.geometric_normal = {0, 1, 0};
    EXPECT_EQ(shadows.query(away, 0).visibility, 1.0f);
  }
}

// Rays end before what the light touches, from straight below and from the side.
TEST(SoftShadows, TheCeilingDoesNotHideALightInIt) {
  const float heights[] = {2.0f, 2.1f, 1999.7f};
  for (const float height : heights) {
    const Mesh ceiling = quad({-1000, height, -1000}, {2000, 0, 0}, {0, 0, 2000});
    const DiscLight light{{0, height, 0}, {0, -1, 0}, 0.5f};
    for (const float x : {0.0f, 1.0f, 5.0f}) {
      EXPECT_EQ(mean_visibility(ceiling, light, {.position = {x, 0, 0}, .normal = {0, 1, 0}}), 1.0) << height;
    }
  }
}

// Rays go to the near side of a sphere, evenly over the cone in which it is seen; from within, all around.
TEST(SoftShadows, RaysEndOnTheSphere) {
  const glm::vec3 center(1, 2, -0.5f);
  for (const float distance : {0.2f, 0.6f, 0.9f, 1.1f, 3.0f, 1000.0f}) {
    const Receiver receiver{.position = center - glm::vec3(0, distance, 0), .normal = {0, 1, 0}};
    const SoftShadows shadows({OccluderBvh(Mesh().view())}, SphereLight{center, 1}, SamplePattern::standard(1024),
                              {.surface_offset = 0});
    const ReceiverRays rays = shadows.rays(receiver, 3);
    const bool is_within = distance < 1;
    double cosine_sum = 0;
    for (int i = 0; i < rays.ray_count; ++i) {
      const glm::dvec3 ray(rays.ray(i));
      EXPECT_NEAR(glm::distance(glm::dvec3(rays.origin) + ray, glm::dvec3(center)), 1, 1e-5 * (1 + distance));
      EXPECT_EQ(rays.cast.test(i), ray.y > 0);
      cosine_sum += ray.y / glm::length(ray);
    }
    const double least = is_within ? -1 : std::sqrt(1 - 1 / (static_cast<double>(distance) * distance));
    EXPECT_NEAR(cosine_sum / 1024, (1 + least) / 2, 1e-3 * (1 - least)) << distance;
  }
}

TEST(SoftShadows, ReceiversOnAndInTheLight) {
  const Mesh wall = quad({0.3f, -9, -9}, {0, 18, 0}, {0, 0, 18});
  const AreaLight lights[] = {DiscLight{{0, 0, 0}, {0, 1, 0}, 1}, DiscLight{{0, 0, 0}, {1, 0, 0}, 1},
                              SphereLight{{0, 0, 0}, 1}, SphereLight{{0, -1, 0}, 1}};
  for (const AreaLight& light : lights) {
    const SoftShadows shadows = shadows_of(wall, light);
    for (const glm::vec3& position : {glm::vec3(0), glm::vec3(0, 1e-30f, 0), glm::vec3(0, 0, 0.5f)}) {
      const LightVisibility answer = shadows.query({.position = position, .normal = {0, 1, 0}}, 0);
      EXPECT_GE(answer.visibility, 0);
      EXPECT_LE(answer.visibility, answer.above_horizon);
      EXPECT_LE(answer.above_horizon, 1);
    }
  }
  // From the middle of a sphere half of it is above the horizon, and 0.35 of that before the wall on one side.
  EXPECT_NEAR(mean_visibility({}, lights[2], kFloor), 0.5, 5e-3);
  EXPECT_NEAR(mean_visibility(wall, lights[2], kFloor), 0.5 * (1 + 0.3) / 2, 5e-3);
}

// A sun: far away, and as large as it is seen.
TEST(SoftShadows, FarLights) {
  const Mesh half = quad({-100, 1, -100}, {0, 0, 200}, {100, 0, 0});
  for (const float distance : {1e4f, 1e8f, 1e16f}) {
    const SphereLight sun{{0, distance, 0}, 0.005f * distance};
    EXPECT_NEAR(mean_visibility(half, sun, kFloor), 0.5, 5e-3) << distance;
    EXPECT_EQ(mean_visibility(half, sun, {.position = {0.01f, 0, 0}, .normal = {0, 1, 0}}), 1.0) << distance;
    EXPECT_EQ(mean_visibility(half, sun, {.position = {-0.01f, 0, 0}, .normal = {0, 1, 0}}), 0.0) << distance;
  }
}

TEST(SoftShadows, InvalidReceiversAnswerNaNAndAreCounted) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const SoftShadows shadows = shadows_of(tests::closed_box(), kLights[0], 64);
  const std::vector<Receiver> receivers = {kFloor,
                                           {.position = {nan, 0, 0}, .normal = {0, 1, 0}},
                                           {.position = {}, .normal = {0, 0, 0}},
                                           {.position = {1e18f, 0, 0}, .normal = {0, 1, 0}}};
  std::vector<float> visibility(receivers.size()), above(receivers.size());
  std::vector<std::uint64_t> words(receivers.size(), 7);
  EXPECT_EQ(shadows.query(receivers, {visibility, above, words}).invalid_receiver_count, 3u);
  EXPECT_EQ(visibility[0], 0);
  for (std::size_t k = 1; k < receivers.size(); ++k) {
    EXPECT_TRUE(std::isnan(visibility[k]) && std::isnan(above[k])) << k;
    EXPECT_EQ(words[k], 0u);
    EXPECT_TRUE(std::isnan(shadows.query(receivers[k], k).visibility));
  }
}

class SoftShadowsBy : public tests::OnEveryKernel {};
INSTANTIATE_TEST_SUITE_P(Kernels, SoftShadowsBy, testing::ValuesIn(tests::all_kernels()), tests::name_of_choice);

// Every kernel gives the bits of the definition; a batch those of single receivers; and they are those of a bundle.
TEST_P(SoftShadowsBy, BitsAreThoseOfTheDefinition) {
  const OccluderBvh occluders(tests::random_soup(3000, 0.06f, 211).view());
  const std::vector<Receiver> receivers = tests::with_exclusions(tests::random_receivers(150, 1, 212), 7);
  const AreaLight lights[] = {DiscLight{{0.4f, 2, 0}, {0, -1, 1}, 0.4f}, SphereLight{{-2, 0.4f, 1}, 0.7f}};
  for (const AreaLight& light : lights) {
    const ShadowOptions options{.sidedness = Sidedness::one_sided, .seed = 5};
    const SamplePattern& pattern = SamplePattern::standard(200);
    const SoftShadows definition(occluders, light, pattern, options, Kernel::scalar);
    const SoftShadows shadows(occluders, light, pattern, options, GetParam().kernel);
    const RayBundles bundles(occluders, options.sidedness);
    std::vector<float> visibility(receivers.size());
    std::vector<std::uint64_t> words(receivers.size() * 4);
    const QueryReport report = shadows.query(receivers, {.visibility = visibility, .mask_words = words}, 10);
    EXPECT_GT(report.blocked_ray_count, report.ray_count / 10);
    EXPECT_LT(report.blocked_ray_count, report.ray_count * 9 / 10);
    for (std::size_t k = 0; k < receivers.size(); ++k) {
      const LightVisibility expected = definition.query(receivers[k], 10 + k),
                            single = shadows.query(receivers[k], 10 + k);
      ASSERT_EQ(single.blocked, expected.blocked) << k;
      ASSERT_EQ(visibility[k], expected.visibility) << k;
      ASSERT_EQ(single.visibility, expected.visibility) << k;
      for (std::size_t word = 0; word < 4; ++word) ASSERT_EQ(words[4 * k + word], expected.blocked.words[word]) << k;
      const ReceiverRays rays = shadows.rays(receivers[k], 10 + k);
      std::vector<glm::vec3> bundle;
      bundle.reserve(200);
      for (int i = 0; i < 200; ++i) bundle.push_back(rays.ray(i));
      ASSERT_EQ(rays.cast & bundles.blocked(rays.origin, bundle, receivers[k].excluded_primitive), expected.blocked);
    }
  }
}

// A scene of instances has the shadows of the one mesh that it stands for.
TEST_P(SoftShadowsBy, InstancesCastTheShadowsOfOneMesh) {
  lut::RandomStream random(215);
  const Mesh mesh = tests::random_soup(300, 0.2f, 216);
  std::vector<MeshInstance> instances;
  instances.reserve(6);
  for (int i = 0; i < 6; ++i) {
    const glm::vec3 scale(i % 2 == 0 ? 0.4f : -0.3f, 0.4f, 0.5f);
    instances.push_back(
        tests::instance_of(mesh, tests::random_transform(random, scale, tests::random_point(random, 1))));
  }
  const ShadowOptions options{.surface_offset = 0};
  const SphereLight light{{0, 2, 0}, 0.5f};
  const SamplePattern& pattern = SamplePattern::standard(100);
  const SoftShadows definition(OccluderBvh(tests::flattened(instances).view()), light, pattern, options,
                               Kernel::scalar);
  const SoftShadows shadows(OccluderScene(instances), light, pattern, options, GetParam().kernel);
  const std::vector<Receiver> receivers = tests::random_receivers(100, 1, 217);
  std::vector<std::uint64_t> words(2 * receivers.size()), expected(2 * receivers.size());
  const QueryReport report = definition.query(receivers, {.mask_words = expected});
  EXPECT_GT(report.blocked_ray_count, report.ray_count / 20);
  EXPECT_LT(report.blocked_ray_count, report.ray_count * 19 / 20);
  shadows.query(receivers, {.mask_words = words});
  EXPECT_EQ(words, expected);
}

TEST(SoftShadows, AnyNumberOfThreadsGivesTheSameBits) {
  const SoftShadows shadows = shadows_of(tests::random_soup(3000, 0.06f, 213), kLights[1], 128);
  const std::vector<Receiver> receivers = tests::random_receivers(1000, 1, 214);
  std::vector<std::uint64_t> expected;
  for (const int thread_count : {1, 2, 7}) {
    const tbb::global_control workers(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(thread_count));
    std::vector<std::uint64_t> words(receivers.size() * 2);
    tbb::task_arena(thread_count).execute([&] {
      EXPECT_GT(shadows.query(receivers, {.mask_words = words}).blocked_ray_count, 1000u);
    });
    if (expected.empty()) expected = words;
    EXPECT_EQ(words, expected) << thread_count;
  }
}

template <typename Call>
std::string error_of_light(const Call& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(SoftShadows, NameBadArguments) {
  const OccluderBvh occluders(tests::closed_box().view());
  const auto error_with = [&](const AreaLight& light, const ShadowOptions& options = {}) {
    return error_of_light([&] { SoftShadows(occluders, light, SamplePattern::standard(16), options); });
  };
  const std::string radius = "light.radius must be greater than 0 and at most 1e17, not ";
  EXPECT_EQ(error_with(SphereLight{{}, 1}), "");
  EXPECT_EQ(error_with(SphereLight{{}, 0}), radius + "0");
  EXPECT_EQ(error_with(DiscLight{{}, {0, 1, 0}, -1}), radius + "-1");
  EXPECT_EQ(error_with(SphereLight{{0, 2e17f, 0}, 1}), "light.position must be within 1e17, not (0, 2e+17, 0)");
  EXPECT_EQ(error_with(DiscLight{{}, {0, 0, 0}, 1}), "light.normal must be finite and not zero, not (0, 0, 0)");
  EXPECT_EQ(error_with(SphereLight{{}, 1}, {.rotation = 2}), "rotation must be in [0, 1] turns, not 2");
  EXPECT_EQ(error_with(SphereLight{{}, 1}, {.surface_offset = -3}),
            "surface_offset must be finite and at least 0, or automatic (-1), not -3");
  const SoftShadows shadows = shadows_of(tests::closed_box(), kLights[0], 64);
  const std::vector<Receiver> receivers(3, kFloor);
  std::vector<float> two(2);
  std::vector<std::uint64_t> words(4);
  EXPECT_EQ(error_of_light([&] { shadows.query(receivers, {.visibility = two}); }),
            "outputs.visibility has 2 entries, not 0 or 3");
  EXPECT_EQ(error_of_light([&] { shadows.query(receivers, {.above_horizon = two}); }),
            "outputs.above_horizon has 2 entries, not 0 or 3");
  EXPECT_EQ(error_of_light([&] { shadows.query(receivers, {.mask_words = words}); }),
            "outputs.mask_words has 4 entries, not 0 or 3");
}

}  // namespace
}  // namespace lkao
