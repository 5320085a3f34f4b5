// Scenes whose occlusion is known in closed form.
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "lkao/lkao.h"
#include "support/meshes.h"

namespace lkao {
namespace {

using tests::Mesh;

// Mean over many jittered receivers at one place: what is left is bias, not noise.
double mean_occlusion(const Mesh& mesh, const Receiver& receiver, const RayOptions& options, int ray_count = 128,
                      const Falloff& falloff = Falloff::constant(), Weighting weighting = Weighting::cosine) {
  const AmbientOcclusion ao(OccluderBvh(mesh.view()),
                            SamplePattern::standard(ray_count, weighting).with_falloff(falloff), options);
  constexpr int kCount = 500;
  const std::vector<Receiver> receivers(kCount, receiver);
  std::vector<float> occlusion(kCount);
  EXPECT_EQ(ao.query(receivers, {.occlusion = occlusion}).invalid_receiver_count, 0u);
  double sum = 0;
  for (float value : occlusion) sum += value;
  return sum / kCount;
}

constexpr Receiver kOrigin{.position = {0, 0, 0}, .normal = {0, 1, 0}};

Mesh floor_mesh() {
  Mesh mesh;
  tests::add_quad(mesh, {-50, 0, -50}, {0, 0, 100}, {100, 0, 0});
  return mesh;
}

TEST(Analytic, OpenPlaneIsZero) {
  EXPECT_EQ(mean_occlusion(floor_mesh(), kOrigin, {.radius = 5}), 0.0);
  EXPECT_EQ(mean_occlusion(floor_mesh(), {.position = {3.3f, 0, -7.7f}, .normal = {0, 1, 0}}, {.radius = 5}), 0.0);
}

TEST(Analytic, ClosedBoxIsOne) {
  EXPECT_EQ(mean_occlusion(tests::closed_box(), kOrigin, {.radius = 5}), 1.0);
  EXPECT_EQ(mean_occlusion(tests::closed_box(), kOrigin, {.radius = 0.99f}), 0.0);
}

// A receiver at distance x from an infinite wall, radius r: with h = x / r, the part of the unit disk beyond h.
TEST(Analytic, WallFoot) {
  Mesh wall;
  tests::add_quad(wall, {0, 0, -100}, {0, 100, 0}, {0, 0, 200});
  for (float h : {1e-4f, 0.1f, 0.5f, 0.9f}) {
    const double expected = (std::acos(h) - h * std::sqrt(1 - h * h)) / std::numbers::pi;
    EXPECT_NEAR(mean_occlusion(wall, {.position = {h * 3, 0, 0}, .normal = {0, 1, 0}}, {.radius = 3}), expected, 1e-3)
        << h;
  }
}

Mesh disk_mesh(float radius, float height) {
  Mesh mesh;
  constexpr int kCorners = 720;
  mesh.positions.emplace_back(0, height, 0);
  for (int i = 0; i < kCorners; ++i) {
    const float turn = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kCorners;
    mesh.positions.emplace_back(radius * std::cos(turn), height, radius * std::sin(turn));
  }
  for (unsigned i = 0; i < kCorners; ++i) mesh.triangles.emplace_back(0, 1 + i, 1 + (i + 1) % kCorners);
  return mesh;
}

// Form factor of a coaxial disk.
TEST(Analytic, CoaxialDisk) {
  for (float height : {0.3f, 1.0f, 2.0f}) {
    const double expected = 1.0 / (1.0 + static_cast<double>(height) * height);
    EXPECT_NEAR(mean_occlusion(disk_mesh(1, height), kOrigin, {.radius = 20}, 1024), expected, 1e-3) << height;
  }
}

// At the origin itself: no offset that grows with the walls.
double endless_occlusion(const Mesh& mesh, Weighting weighting) {
  const RayOptions options{.radius = std::numeric_limits<float>::infinity(), .surface_offset = 0};
  return mean_occlusion(mesh, kOrigin, options, 1024, Falloff::constant(), weighting);
}

// The disk's share of the solid angle of the hemisphere.
TEST(Analytic, CoaxialDiskWhereTheWeightingIsUniform) {
  for (float height : {0.3f, 1.0f, 2.0f}) {
    const double h = height;
    EXPECT_NEAR(endless_occlusion(disk_mesh(1, height), Weighting::uniform), 1 - h / std::sqrt(1 + h * h), 1e-3) << h;
  }
}

// A wall without ends, seen up to the slope k: a wedge of the angle atan k of the hemisphere, of pi in all. Its form
// factor is that of a strip.
TEST(Analytic, WallUnderEachWeighting) {
  for (float slope : {0.2f, 1.0f, 5.0f}) {
    Mesh wall;
    tests::add_quad(wall, {1, 0, -1e4f}, {0, slope, 0}, {0, 0, 2e4f});
    const double k = slope;
    EXPECT_NEAR(endless_occlusion(wall, Weighting::uniform), std::atan(k) / std::numbers::pi, 5e-4) << slope;
    EXPECT_NEAR(endless_occlusion(wall, Weighting::cosine), 0.5 * (1 - 1 / std::sqrt(1 + k * k)), 5e-4) << slope;
  }
}

// Form factor of a sphere on the axis.
TEST(Analytic, SphereOnTheAxis) {
  Mesh sphere = tests::closed_sphere(256, 128);
  for (glm::vec3& p : sphere.positions) p += glm::vec3(0, 3, 0);
  EXPECT_NEAR(mean_occlusion(sphere, kOrigin, {.radius = 20}, 1024), 1.0 / 9.0, 1e-3);
}

// A ceiling that covers everything at height h: rays are blocked where length x cosine exceeds h, so occlusion is the
// integral of rho(h / cosine) over the unit disk = integral over c of rho(h / c) 2 c dc from h to 1 (Eq. 1).
TEST(Analytic, CeilingUnderEachFalloff) {
  Mesh ceiling;
  tests::add_quad(ceiling, {-1000, 1, -1000}, {2000, 0, 0}, {0, 0, 2000});
  for (const Falloff& falloff : {Falloff::constant(), Falloff::linear(), Falloff::smooth(), Falloff::exponential(3)}) {
    const float radius = 2;
    double expected = 0;
    constexpr int kSteps = 100'000;
    for (int i = 0; i < kSteps; ++i) {
      const double c = (i + 0.5) / kSteps;
      if (1.0 / (radius * c) <= 1) expected += falloff(1.0 / (radius * c)) * 2 * c / kSteps;
    }
    // No turn about the normal changes this scene, so jitter does not average: half the error of random rays.
    const double tolerance = 0.5 * std::sqrt(expected * (1 - expected) / 1024);
    EXPECT_NEAR(mean_occlusion(ceiling, kOrigin, {.radius = radius}, 1024, falloff), expected, tolerance)
        << falloff.name();
  }
}

TEST(Analytic, OneSidedOccludersBlockFromTheirFrontOnly) {
  Mesh ceiling;
  tests::add_quad(ceiling, {-1000, 1, -1000}, {2000, 0, 0}, {0, 0, 2000});  // front downwards
  const Receiver below = kOrigin, above{.position = {0, 2, 0}, .normal = {0, -1, 0}};
  const RayOptions one_sided{.radius = 1e6f, .sidedness = Sidedness::one_sided}, two_sided{.radius = 1e6f};
  EXPECT_GT(mean_occlusion(ceiling, below, one_sided), 0.99);
  EXPECT_EQ(mean_occlusion(ceiling, above, one_sided), 0.0);
  EXPECT_GT(mean_occlusion(ceiling, above, two_sided), 0.99);
}

}  // namespace
}  // namespace lkao
