// From inside a closed mesh, with a radius beyond its walls or without end, every ray is blocked: not one leaks between
// triangles.
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "lkao/lkao.h"
#include "support/meshes.h"

namespace lkao {
namespace {

constexpr int kReceiverCount = 10'000;

// One way to put a mesh into the world: scale x (rotation x mesh + offset). An offset of 1e4 leaves a float some 1e-3
// of the mesh's size as its finest step.
struct Placement {
  glm::quat rotation;
  glm::vec3 offset;
  float scale;

  glm::vec3 operator()(const glm::vec3& p) const { return (rotation * p + offset) * scale; }
};

std::vector<Placement> placements() {
  lut::RandomStream random(81);
  std::vector<Placement> all;
  const float offsets[] = {0, 1, 1e2f, 1e4f}, scales[] = {1e-3f, 1, 1e3f};
  for (int i = 0; i < 10; ++i) {
    all.push_back({tests::random_rotation(random), tests::random_direction(random) * offsets[i % 4], scales[i % 3]});
  }
  return all;
}

// Receivers at random places inside, in random directions, and on the walls, facing inwards.
std::vector<Receiver> receivers_inside(const tests::Mesh& placed, const tests::Mesh& mesh, const Placement& placement,
                                       std::uint64_t seed) {
  lut::RandomStream random(seed);
  std::vector<Receiver> receivers;
  const glm::vec3 center = placement(glm::vec3(0));
  while (receivers.size() < kReceiverCount) {
    const glm::uvec3& t = placed.triangles[random.next_below(placed.triangles.size())];
    // Keeps clear of the triangle's own edges, where the neighbouring wall is within rounding.
    const float u = tests::uniform(random, 0.1f, 0.8f), v = tests::uniform(random, 0.1f, 0.9f - u);
    if (receivers.size() % 5 == 0) {
      const glm::dvec3 a(placed.positions[t.x]), b(placed.positions[t.y]), c(placed.positions[t.z]);
      const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
      const glm::dvec3 position = a + static_cast<double>(u) * (b - a) + static_cast<double>(v) * (c - a);
      receivers.push_back(
          {.position = position, .normal = glm::dot(normal, glm::dvec3(center) - position) > 0 ? normal : -normal});
    } else {
      // Meshes are convex around 0: a share of the way to a wall is inside.
      const glm::vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
      const glm::vec3 wall = a + u * (b - a) + v * (c - a);
      receivers.push_back(
          {.position = placement(wall * tests::uniform(random, 0, 0.95f)), .normal = tests::random_direction(random)});
    }
  }
  return receivers;
}

void expect_no_leak(const tests::Mesh& mesh) {
  std::uint64_t seed = 82;
  for (const Placement& placement : placements()) {
    tests::Mesh placed = mesh;
    for (glm::vec3& p : placed.positions) p = placement(p);
    const OccluderBvh occluders(placed.view());
    ASSERT_EQ(occluders.report().occluder_count, mesh.triangles.size());
    const std::vector<Receiver> receivers = receivers_inside(placed, mesh, placement, seed++);
    for (const float radius : {5 * placement.scale, std::numeric_limits<float>::infinity()}) {
      const std::size_t count = std::isinf(radius) ? kReceiverCount / 4 : kReceiverCount;
      const AmbientOcclusion ao(occluders, SamplePattern::standard(1024), {.radius = radius});
      const QueryReport report = ao.query(std::span(receivers).first(count), {});
      EXPECT_EQ(report.invalid_receiver_count, 0u);
      EXPECT_EQ(report.ray_count, count * 1024);
      EXPECT_EQ(report.ray_count - report.blocked_ray_count, 0u)
          << "rays leak at radius " << radius << ", offset " << glm::length(placement.offset) << ", scale "
          << placement.scale;
    }
  }
}

TEST(ClosedMeshes, BoxDoesNotLeak) { expect_no_leak(tests::closed_box()); }

TEST(ClosedMeshes, SphereDoesNotLeak) { expect_no_leak(tests::closed_sphere(32, 16)); }

}  // namespace
}  // namespace lkao
