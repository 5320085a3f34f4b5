#include "bvh/leaf.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "support/meshes.h"

namespace lkao::bvh {
namespace {

PackedMesh one_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) { return {{a, b, c}, {{0, 1, 2}}}; }

glm::dvec3 at(const float (&field)[3][kLeafWidth], int triangle) {
  return {field[0][triangle], field[1][triangle], field[2][triangle]};
}

double u_of(const Leaf& leaf, int triangle, const glm::dvec3& point) {
  return glm::dot(at(leaf.u_gradient, triangle), point - at(leaf.vertex, triangle));
}

double v_of(const Leaf& leaf, int triangle, const glm::dvec3& point) {
  return glm::dot(at(leaf.v_gradient, triangle), point - at(leaf.vertex, triangle));
}

TEST(Leaf, HoldsAKnownTriangle) {
  const PackedMesh mesh = one_triangle({0, 0, 2}, {4, 0, 2}, {0, 2, 2});
  const Leaf leaf = make_leaf(mesh, std::vector{0u});
  EXPECT_EQ(at(leaf.vertex, 0), glm::dvec3(0, 0, 2));
  EXPECT_EQ(at(leaf.u_gradient, 0), glm::dvec3(0.25, 0, 0));
  EXPECT_EQ(at(leaf.v_gradient, 0), glm::dvec3(0, 0.5, 0));
  EXPECT_EQ(at(leaf.back_normal, 0), glm::dvec3(0, 0, -1));
  EXPECT_EQ(leaf.steepness[0], 0.5f);
}

TEST(Leaf, CornersHaveTheirBarycentricCoordinates) {
  lut::RandomStream random(51);
  for (int i = 0; i < 2000; ++i) {
    const float scale = std::pow(10.0f, tests::uniform(random, -6, 6));
    const glm::vec3 corners[3] = {tests::random_point(random, scale), tests::random_point(random, scale),
                                  tests::random_point(random, scale)};
    const PackedMesh mesh = one_triangle(corners[0], corners[1], corners[2]);
    const Leaf leaf = make_leaf(mesh, std::vector{0u});
    const glm::dvec3 a(corners[0]), b(corners[1]), c(corners[2]);
    const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
    const double reach = glm::length(b - a) + glm::length(c - a);
    const double error = 0x1p-22 * static_cast<double>(leaf.steepness[0]) * reach;  // of the gradients, as floats
    if (error > 0.01) continue;                                                     // a sliver

    // One corner each with (u, v) = (0, 0), (1, 0), (0, 1), in this order around the triangle; longest edge opposite
    // the first.
    int first = 0;
    while (first < 3 && glm::dvec3(corners[first]) != at(leaf.vertex, 0)) ++first;
    ASSERT_LT(first, 3) << i;
    const glm::dvec3 second(corners[(first + 1) % 3]), third(corners[(first + 2) % 3]);
    ASSERT_NEAR(u_of(leaf, 0, second), 1, error) << i;
    ASSERT_NEAR(v_of(leaf, 0, second), 0, error) << i;
    ASSERT_NEAR(u_of(leaf, 0, third), 0, error) << i;
    ASSERT_NEAR(v_of(leaf, 0, third), 1, error) << i;
    const double opposite = glm::distance(second, third);
    ASSERT_GE(opposite, std::max(glm::distance(a, b), std::max(glm::distance(b, c), glm::distance(c, a)))) << i;

    ASSERT_NEAR(glm::length(at(leaf.back_normal, 0)), 1, 1e-6) << i;
    ASSERT_NEAR(glm::dot(at(leaf.back_normal, 0), normal), -1, 1e-6) << i;
    double steepest = 0;
    for (int axis = 0; axis < 3; ++axis) {
      for (const auto& gradient : {at(leaf.u_gradient, 0), at(leaf.v_gradient, 0)}) {
        steepest = std::max(steepest, std::fabs(gradient[axis]));
      }
    }
    ASSERT_EQ(leaf.steepness[0], static_cast<float>(steepest)) << i;
  }
}

// Corners far out on a line, one of them a step off it: in double precision the normal is noise.
TEST(Leaf, ThinTrianglesAreLeftToTheTest) {
  const PackedMesh mesh = one_triangle({0, 0, 0}, {1e7f, 1e7f, 0}, {2e7f, 2e7f, 1e-9f});
  const Leaf leaf = make_leaf(mesh, std::vector{0u});
  EXPECT_EQ(leaf.steepness[0], INFINITY);
  EXPECT_EQ(at(leaf.u_gradient, 0), glm::dvec3(0));
  EXPECT_EQ(at(leaf.v_gradient, 0), glm::dvec3(0));
  EXPECT_EQ(at(leaf.back_normal, 0), glm::dvec3(0));
}

// So small that gradients do not fit a float.
TEST(Leaf, GradientsBeyondFloatAreLeftToTheTest) {
  const PackedMesh mesh = one_triangle({0, 0, 0}, {1e-39f, 0, 0}, {0, 1e-39f, 0});
  EXPECT_EQ(make_leaf(mesh, std::vector{0u}).steepness[0], INFINITY);
}

TEST(Leaf, PlacesThatAreLeftRepeatTheFirstTriangle) {
  const PackedMesh mesh = pack(tests::random_soup(4, 0.5f, 52).view());
  const std::vector<std::uint32_t> primitives = {2, 0, 3, 1};
  for (std::size_t count = 1; count <= primitives.size(); ++count) {
    const Leaf leaf = make_leaf(mesh, {primitives.data(), count});
    EXPECT_EQ(leaf.triangle_count(), static_cast<int>(count));
    for (std::size_t place = 0; place < kLeafWidth; ++place) {
      const std::uint32_t expected = primitives[place < count ? place : 0];
      const int i = static_cast<int>(place);
      EXPECT_EQ(leaf.primitives[place], expected) << count << " " << place;
      const Leaf single = make_leaf(mesh, {&expected, 1});
      EXPECT_EQ(at(leaf.vertex, i), at(single.vertex, 0)) << count << " " << place;
      EXPECT_EQ(at(leaf.u_gradient, i), at(single.u_gradient, 0)) << count << " " << place;
      EXPECT_EQ(at(leaf.v_gradient, i), at(single.v_gradient, 0)) << count << " " << place;
      EXPECT_EQ(at(leaf.back_normal, i), at(single.back_normal, 0)) << count << " " << place;
      EXPECT_EQ(leaf.steepness[place], single.steepness[0]) << count << " " << place;
    }
  }
}

}  // namespace
}  // namespace lkao::bvh
