#include "bvh/ray_triangle.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "support/brute_force.h"
#include "support/meshes.h"

namespace lkao::bvh {
namespace {

constexpr float kRadius = 10;
constexpr Sidedness kTwo = Sidedness::two_sided;

bool blocks(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& origin, const glm::vec3& ray,
            Sidedness sidedness = kTwo) {
  const TriangleTest test(a, b, c, origin, kRadius, sidedness);
  return test.can_block() && test.blocks(ray);
}

// The triangle of most cases below: in the plane z = 2, front towards +z.
constexpr glm::vec3 kA{0, 0, 2}, kB{1, 0, 2}, kC{0, 1, 2};

TEST(TriangleTest, BlocksRaysThroughTheInside) {
  EXPECT_TRUE(blocks(kA, kB, kC, {0.25f, 0.25f, 0}, {0, 0, 3}));
  EXPECT_TRUE(blocks(kA, kB, kC, {0.25f, 0.25f, 4}, {0, 0, -3}));
  EXPECT_TRUE(blocks(kA, kC, kB, {0.25f, 0.25f, 0}, {0, 0, 3}));
  EXPECT_FALSE(blocks(kA, kB, kC, {0.6f, 0.6f, 0}, {0, 0, 3}));
  EXPECT_FALSE(blocks(kA, kB, kC, {0.25f, 0.25f, 0}, {0, 0, -3}));
}

TEST(TriangleTest, ClosedAtTheEndOfTheRay) {
  EXPECT_TRUE(blocks(kA, kB, kC, {0.25f, 0.25f, 0}, {0, 0, 2}));
  EXPECT_FALSE(blocks(kA, kB, kC, {0.25f, 0.25f, 0}, {0, 0, std::nextafter(2.0f, 0.0f)}));
}

TEST(TriangleTest, OpenAtTheOrigin) {
  for (const glm::vec3& ray : {glm::vec3(0, 0, 1), glm::vec3(0, 0, -1), glm::vec3(1, 0, 0), glm::vec3(1, 1, 1)}) {
    EXPECT_FALSE(blocks(kA, kB, kC, {0.25f, 0.25f, 2}, ray));
    EXPECT_FALSE(blocks(kA, kB, kC, kA, ray));
  }
  EXPECT_TRUE(blocks(kA, kB, kC, {0.25f, 0.25f, std::nextafter(2.0f, 0.0f)}, {0, 0, 1}));
}

TEST(TriangleTest, EdgesAndCornersBelongToTheTriangle) {
  const glm::vec3 origin(0.25f, 0.25f, 0);
  for (const glm::vec3& target : {kA, kB, kC, (kA + kB) * 0.5f, (kB + kC) * 0.5f, (kC + kA) * 0.5f}) {
    EXPECT_TRUE(blocks(kA, kB, kC, origin, target - origin));
    EXPECT_TRUE(blocks(kC, kB, kA, origin, target - origin));
  }
}

TEST(TriangleTest, OneSidedBlocksOnlyInFront) {
  EXPECT_TRUE(blocks(kA, kB, kC, {0.25f, 0.25f, 4}, {0, 0, -3}, Sidedness::one_sided));
  EXPECT_FALSE(blocks(kA, kB, kC, {0.25f, 0.25f, 0}, {0, 0, 3}, Sidedness::one_sided));
  EXPECT_TRUE(blocks(kA, kC, kB, {0.25f, 0.25f, 0}, {0, 0, 3}, Sidedness::one_sided));
}

TEST(TriangleTest, ZeroRayMeetsNothing) { EXPECT_FALSE(blocks(kA, kB, kC, {0.25f, 0.25f, 1}, {0, 0, 0})); }

TEST(TriangleTest, PlaneBeyondTheRadiusCannotBlock) {
  const glm::vec3 origin(0.25f, 0.25f, 0);
  EXPECT_FALSE(TriangleTest(kA, kB, kC, origin, 1.9f, kTwo).can_block());
  EXPECT_TRUE(TriangleTest(kA, kB, kC, origin, 2.0f, kTwo).can_block());
}

// Random rays at random triangles: the same answer as long-double arithmetic of another kind.
TEST(TriangleTest, AgreesWithTheTextbook) {
  lut::RandomStream random(11);
  int hit_count = 0;
  for (int i = 0; i < 300'000; ++i) {
    const float size = std::pow(10.0f, tests::uniform(random, -3, 1));
    const glm::vec3 center = tests::random_point(random, 3);
    glm::vec3 corners[3];
    for (glm::vec3& corner : corners) corner = center + tests::random_point(random, size);
    const glm::vec3 origin = tests::random_point(random, 1);
    // Aimed near the triangle, ending before or behind it.
    const glm::vec3 ray = (center + tests::random_point(random, size) - origin) * tests::uniform(random, 0.5f, 2);
    const Sidedness sidedness = i % 2 ? Sidedness::one_sided : kTwo;
    const bool expected = tests::textbook_blocks(corners[0], corners[1], corners[2], origin, ray, sidedness);
    ASSERT_EQ(blocks(corners[0], corners[1], corners[2], origin, ray, sidedness), expected) << i;
    hit_count += expected;
  }
  EXPECT_GT(hit_count, 10'000);
}

// Rays aimed, in floats, at points of a shared edge: rounding puts them on either side, never between the triangles.
TEST(TriangleTest, NoRayPassesBetweenTrianglesThatShareAnEdge) {
  lut::RandomStream random(12);
  for (int i = 0; i < 300'000; ++i) {
    const glm::vec3 offset = tests::random_direction(random) * std::pow(10.0f, tests::uniform(random, -2, 4));
    const glm::vec3 a = offset + tests::random_point(random, 1), b = offset + tests::random_point(random, 1);
    // Outer corners on opposite sides of the plane through the origin and the edge, seen from the origin.
    const glm::vec3 origin = offset + tests::random_point(random, 1);
    const glm::vec3 side = glm::cross(a - origin, b - origin), middle = (a + b) * 0.5f;
    const glm::vec3 left = middle + side, right = middle - side;
    const float share = tests::uniform(random, 0.01f, 0.99f);
    const glm::vec3 ray = (a + (b - a) * share - origin) * 1.01f;
    // Without a wide view of the edge the origin is as good as on it.
    if (glm::length(side) < 0.05f) continue;
    ASSERT_TRUE(blocks(a, b, left, origin, ray) || blocks(b, a, right, origin, ray)) << i;
  }
}

// A fan of slivers around a vertex, and rays aimed at that vertex.
TEST(TriangleTest, NoRayPassesThroughTheHubOfAFan) {
  lut::RandomStream random(13);
  constexpr int kSpokes = 500;
  for (int i = 0; i < 300; ++i) {
    const glm::vec3 offset = tests::random_direction(random) * std::pow(10.0f, tests::uniform(random, -2, 3));
    const glm::quat turn = tests::random_rotation(random);
    const auto rim = [&](int spoke) {
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(spoke % kSpokes) / kSpokes;
      return offset + turn * glm::vec3(std::cos(angle), std::sin(angle), 0.1f * std::sin(5 * angle));
    };
    const glm::vec3 hub = offset + turn * glm::vec3(0, 0, 0.05f);
    const glm::vec3 origin = offset + turn * glm::vec3(0.2f, 0.1f, -0.7f);
    const glm::vec3 ray = (hub - origin) * 1.5f;
    bool blocked = false;
    for (int spoke = 0; spoke < kSpokes; ++spoke) blocked |= blocks(hub, rim(spoke), rim(spoke + 1), origin, ray);
    ASSERT_TRUE(blocked) << i;
  }
}

// Dropping the zero-area triangle of a T-junction must not open a gap: (a, m, b) on one line, m in the middle.
TEST(TriangleTest, NoRayPassesThroughATJunctionOfADroppedTriangle) {
  lut::RandomStream random(14);
  for (int i = 0; i < 100'000; ++i) {
    // Coordinates of few bits, so that the middle is exact.
    const auto coarse = [&] { return glm::round(tests::random_point(random, 1024)) * 0x1p-9f; };
    const glm::vec3 a = coarse(), b = coarse(), m = (a + b) * 0.5f, origin = tests::random_point(random, 2);
    if (!has_zero_area(a, m, b)) continue;
    const glm::vec3 side = glm::cross(a - origin, b - origin);
    if (glm::length(side) < 0.1f) continue;
    const glm::vec3 left = m + side, right = m - side;
    const glm::vec3 ray = (a + (b - a) * tests::uniform(random, 0.01f, 0.99f) - origin) * 1.01f;
    ASSERT_TRUE(blocks(a, b, left, origin, ray) || blocks(a, m, right, origin, ray) || blocks(m, b, right, origin, ray))
        << i;
  }
}

}  // namespace
}  // namespace lkao::bvh
