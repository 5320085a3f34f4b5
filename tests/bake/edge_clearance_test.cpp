#include "bake/edge_clearance.h"

#include <algorithm>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "bake/meshes.h"
#include "lut/random.h"

namespace lkao::bake {
namespace {

Mesh one_triangle(const glm::vec3& c) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {4, 0, 1}, c};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

double distance_from_edges(const scene::Facet& facet, const glm::dvec3& weights) {
  const glm::dvec3 point =
      weights.x * glm::dvec3(facet.a) + weights.y * glm::dvec3(facet.b) + weights.z * glm::dvec3(facet.c);
  double least = 1e300;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 from(facet.corner(i)), edge = glm::normalize(glm::dvec3(facet.corner((i + 1) % 3)) - from);
    least = std::min(least, glm::length(glm::cross(point - from, edge)));
  }
  return least;
}

TEST(EdgeClearance, PointsKeepTheirDistance) {
  const Mesh mesh = one_triangle({1, 3, 0});
  const scene::Facet facet(mesh, mesh.triangles[0]);
  const InscribedCircle circle(facet);
  EXPECT_NEAR(distance_from_edges(facet, circle.weights), circle.radius, 1e-12);
  constexpr double kClearance = 0.125;
  lut::RandomStream random(2);
  for (int i = 0; i < 500; ++i) {
    // Many of them on edges and at corners.
    glm::dvec3 weights(random.next_double(), random.next_double(), random.next_double());
    for (int k = 0; k < 3; ++k) weights[k] = std::max(0.0, weights[k] - 0.4 * (i % 3));
    if (weights == glm::dvec3(0.0)) weights[i % 3] = 1;
    weights /= weights.x + weights.y + weights.z;
    const glm::dvec3 kept = keep_from_edges(weights, circle, kClearance);
    EXPECT_NEAR(kept.x + kept.y + kept.z, 1, 1e-12);
    EXPECT_GE(distance_from_edges(facet, kept), kClearance - 1e-12);
    if (distance_from_edges(facet, weights) >= kClearance) {
      EXPECT_EQ(kept, weights);
    } else {
      EXPECT_NEAR(distance_from_edges(facet, kept), kClearance, 1e-12);
    }
  }
}

TEST(EdgeClearance, OfASliverOnlyTheMiddleIsLeft) {
  const Mesh mesh = one_triangle({2, 0.01f, 0.5f});
  const InscribedCircle circle(scene::Facet(mesh, mesh.triangles[0]));
  EXPECT_EQ(keep_from_edges({1, 0, 0}, circle, 0.125), circle.weights);
}

}  // namespace
}  // namespace lkao::bake
