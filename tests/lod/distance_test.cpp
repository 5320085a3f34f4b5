#include "lod/distance.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "lod/meshes.h"
#include "lod/surface_samples.h"
#include "lod/triangle.h"

namespace lkao::lod {
namespace {

Distance distance(const scene::Mesh& from, const scene::Mesh& to, double spacing) {
  const Surface surface(to);
  return sum(triangle_distances(from, surface, {.spacing = spacing, .most_per_triangle = 1e9}));
}

scene::Mesh square(float height, float size = 1) {
  return {.positions = {{0, height, 0}, {size, height, 0}, {size, height, size}, {0, height, size}},
          .triangles = {{0, 2, 1}, {0, 3, 2}}};
}

TEST(TriangleDistance, InsideOnASideAndAtACorner) {
  const Triangle t{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}};
  EXPECT_DOUBLE_EQ(squared_distance({1, 1, 2}, t), 4);
  EXPECT_DOUBLE_EQ(squared_distance({2, -3, 4}, t), 25);
  EXPECT_DOUBLE_EQ(squared_distance({-3, -4, 0}, t), 25);
  EXPECT_NEAR(squared_distance({4, 3, 0}, t), 2.4 * 2.4, 1e-12);  // over the long side
}

void expect_covered(const Triangle& t, double spacing) {
  double area = 0;
  std::vector<glm::dvec3> samples;
  sample_triangle(t, spacing, [&](const glm::dvec3& point, double share) {
    EXPECT_LT(squared_distance(point, t), 1e-24);
    area += share;
    samples.push_back(point);
    return true;
  });
  EXPECT_NEAR(area, area_of(t), 1e-12);
  for (int i = 0; i <= 60; ++i) {
    for (int j = 0; i + j <= 60; ++j) {
      const glm::dvec3 p = t.a + (t.b - t.a) * (i / 60.0) + (t.c - t.a) * (j / 60.0);
      double nearest = 1e9;
      for (const glm::dvec3& sample : samples) nearest = std::min(nearest, glm::distance(p, sample));
      EXPECT_LE(nearest, kCoverPerSpacing * spacing);
    }
  }
}

TEST(SurfaceSamples, CoverTheTriangleAndAddUpToIt) {
  for (const double spacing : {3.0, 0.3, 0.1}) {
    expect_covered({{0, 0, 0}, {1, 0.1, 0}, {0.3, 2, 0.5}}, spacing);
    expect_covered({{0, 0, 0}, {5, 0, 0}, {0.2, 0.01, 0}}, spacing);  // a needle
    expect_covered({{1, 1, 1}, {1, 2, 1}, {1, 1, 2}}, spacing);
  }
}

TEST(SurfaceSamples, EndWhereTheyAreNotWanted) {
  int count = 0;
  EXPECT_FALSE(sample_triangle({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0.01,
                               [&count](const glm::dvec3&, double) { return ++count < 7; }));
  EXPECT_EQ(count, 7);
}

TEST(Distance, BetweenParallelPlanesIsTheirDistance) {
  const Distance d = distance(square(0), square(0.25f), 0.1);
  EXPECT_DOUBLE_EQ(d.maximum, 0.25);
  EXPECT_NEAR(d.rms(), 0.25, 1e-12);
  EXPECT_NEAR(d.area, 1, 1e-12);
  EXPECT_GT(d.sample_count, 100u);
}

TEST(Distance, IsOneSided) {
  // The small square lies on the large one; the large one reaches beyond it.
  EXPECT_EQ(distance(square(0, 1), square(0, 3), 0.1).maximum, 0);
  EXPECT_NEAR(distance(square(0, 3), square(0, 1), 0.1).maximum, 2 * std::sqrt(2.0), 1e-12);
}

TEST(Distance, FindsAPeakBetweenTheVertices) {
  // A roof over a flat square: all vertices of the square are on the roof, its middle is not.
  const scene::Mesh roof{.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {0.5f, 0.5f, 0.5f}},
                         .triangles = {{0, 4, 1}, {1, 4, 2}, {2, 4, 3}, {3, 4, 0}}};
  const Distance d = distance(square(0), roof, 0.02);
  EXPECT_NEAR(d.maximum, 0.5 / std::sqrt(2.0), 0.02);
  EXPECT_LE(d.maximum, 0.5 / std::sqrt(2.0) + 1e-12);
}

TEST(Distance, TheBoundHoldsHoweverFewTheSamples) {
  const scene::Mesh from = wavy_grid(3), to = wavy_grid(40);
  const Surface surface(to);
  const double truth = distance(from, to, 0.002).maximum;
  for (const double most : {1.0, 4.0, 50.0}) {
    const Distance d = sum(triangle_distances(from, surface, {.spacing = 0.01, .most_per_triangle = most}));
    EXPECT_LE(d.maximum, truth + 1e-12);
    EXPECT_GE(d.bound, truth);
    EXPECT_LE(d.sample_count, from.triangles.size() * static_cast<std::size_t>(most) + from.positions.size());
  }
}

TEST(Distance, AgreesWithTryingEveryTriangle) {
  const scene::Mesh mesh = wavy_grid(12);
  const Surface surface(mesh);
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 p(std::fmod(0.37 * i, 1.6) - 0.3, std::fmod(0.11 * i, 0.9) - 0.4, std::fmod(0.53 * i, 1.4) - 0.2);
    double best = 1e9;
    for (const glm::uvec3& t : mesh.triangles) {
      best = std::min(best, squared_distance(p, {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]}));
    }
    EXPECT_EQ(surface.nearest(p).distance, std::sqrt(best));
    EXPECT_TRUE(surface.is_within(p, std::sqrt(best) * (1 + 1e-12)));
    EXPECT_FALSE(surface.is_within(p, std::sqrt(best) * (1 - 1e-12)));
  }
}

TEST(Distance, HoldsFarFromTheOrigin) {
  scene::Mesh near = square(0), far = square(0.25f);
  for (scene::Mesh* mesh : {&near, &far}) {
    for (glm::vec3& p : mesh->positions) p += glm::vec3(20000, -30000, 10000);
  }
  EXPECT_EQ(distance(near, far, 0.1).maximum, 0.25);
}

}  // namespace
}  // namespace lkao::lod
