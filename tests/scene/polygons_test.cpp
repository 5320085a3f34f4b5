// Polygons cut into triangles.
#include "scene/formats/polygons.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "lut/random.h"
#include "scene/formats/file_mesh.h"
#include "support/sanitized.h"

namespace lkao::scene {
namespace {

using Polygon = std::vector<glm::dvec2>;

constexpr double kPi = std::numbers::pi;

double shoelace_area(const Polygon& polygon) {
  double area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    area += (p.x * q.y - p.y * q.x) / 2;
  }
  return area;
}

std::vector<glm::dvec3> in_plane(const Polygon& polygon, const glm::dmat4& to_space) {
  std::vector<glm::dvec3> corners;
  for (const glm::dvec2& p : polygon) corners.emplace_back(to_space * glm::dvec4(p, 0, 1));
  return corners;
}

glm::dmat4 tilt() {
  return glm::rotate(glm::translate(glm::dmat4(1), {3, 400, -5}), 1.1, glm::normalize(glm::dvec3(1, 2, 3)));
}

// n - 2 triangles, all of them the polygon's way around, whose areas sum up to the polygon's: as they cannot cover more
// than it without leaving it, they cover it exactly.
void expect_exact(const Polygon& polygon, const glm::dmat4& to_space = glm::dmat4(1)) {
  PolygonCutter cutter;
  const std::vector<glm::dvec3> corners = in_plane(polygon, to_space);
  const auto triangles = cutter.cut(corners);
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  const glm::dvec3 normal(to_space * glm::dvec4(0, 0, 1, 0));
  const double area = shoelace_area(polygon);
  double sum = 0, smallest = 0;
  for (const glm::uvec3& t : triangles) {
    const double triangle_area =
        glm::dot(glm::cross(corners[t.y] - corners[t.x], corners[t.z] - corners[t.x]), normal) / 2;
    sum += triangle_area;
    smallest = std::min(smallest, triangle_area / area);
  }
  EXPECT_NEAR(sum / area, 1, 1e-9);
  EXPECT_GT(smallest, -1e-9) << "of " << polygon.size();
}

// Also begun at every other corner, turned over and tilted.
void expect_exact_from_all_sides(const Polygon& polygon) {
  for (std::size_t first = 0; first < polygon.size(); first += 1 + polygon.size() / 20) {
    Polygon turned(polygon.begin() + static_cast<std::ptrdiff_t>(first), polygon.end());
    turned.insert(turned.end(), polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(first));
    expect_exact(turned);
    expect_exact(turned, tilt());
    std::reverse(turned.begin(), turned.end());
    expect_exact(turned);
  }
}

Polygon ring(std::size_t corner_count, lut::RandomStream& random) {
  Polygon polygon;
  for (std::size_t i = 0; i < corner_count; ++i) {
    const double angle = 2 * kPi * static_cast<double>(i) / static_cast<double>(corner_count);
    const double radius = 1 + 9 * static_cast<double>(random.next_below(1000)) / 1000;
    polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return polygon;
}

Polygon comb(int tooth_count) {
  Polygon polygon = {{2.0 * tooth_count, -1}, {2.0 * tooth_count, 0}};
  for (int i = tooth_count; i-- > 0;) {
    polygon.emplace_back(2 * i + 1, 50);
    polygon.emplace_back(2 * i, 0);
  }
  polygon.emplace_back(0, -1);
  return polygon;
}

Polygon spiral(int corner_count) {
  Polygon polygon;
  for (int side : {0, 1}) {
    for (int i = 0; i < corner_count; ++i) {
      const double angle = 0.3 * (side == 0 ? i : corner_count - 1 - i);
      const double radius = angle + (side == 0 ? 3 : 1);
      polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
  }
  return polygon;
}

// Square holes one behind the other, each joined to the one before it.
Polygon row_of_holes(int hole_count) {
  Polygon polygon = {{0, 0}, {hole_count, 0}, {hole_count, 1}, {0, 1}, {0, 0.3}};
  for (int x = 0; x < hole_count; ++x) {
    polygon.insert(polygon.end(), {{x + 0.3, 0.3}, {x + 0.3, 0.6}, {x + 0.6, 0.6}, {x + 0.6, 0.3}});
  }
  polygon.emplace_back(hole_count - 0.7, 0.3);
  for (int x = hole_count - 1; x-- > 0;) polygon.insert(polygon.end(), {{x + 0.6, 0.3}, {x + 0.3, 0.3}});
  polygon.emplace_back(0, 0.3);
  return polygon;
}

// Holes that are all joined to the same corner of the outline.
Polygon holes_around_corner(int hole_count) {
  Polygon polygon = {{10, 0}, {10, 10}, {0, 10}, {0, 0}};
  const auto at = [](double radius, double angle) {
    return glm::dvec2(radius * std::cos(angle), radius * std::sin(angle));
  };
  for (int i = hole_count; i > 0; --i) {
    const double angle = kPi / 2 * i / (hole_count + 1), width = 0.3 / hole_count;
    polygon.insert(polygon.end(), {at(3, angle), at(5, angle + width), at(6, angle - width), at(3, angle), {0, 0}});
  }
  return polygon;
}

TEST(Polygons, ConvexOnesAreFans) {
  PolygonCutter cutter;
  Polygon round;
  for (int i = 0; i < 20; ++i) round.emplace_back(std::cos(0.3 * i), std::sin(0.3 * i));
  for (const Polygon& polygon :
       {Polygon{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, Polygon{{0, 0}, {1, 0}, {2, 0}, {1, 1}}, round}) {
    const auto corners = in_plane(polygon, tilt());
    const auto triangles = cutter.cut(corners);
    ASSERT_EQ(triangles.size(), polygon.size() - 2);
    for (std::uint32_t i = 0; i < triangles.size(); ++i) EXPECT_EQ(triangles[i], glm::uvec3(0, i + 1, i + 2));
  }
}

TEST(Polygons, ConcaveQuadsAreCutAtTheirInnerCorner) {
  expect_exact_from_all_sides({{0, 0}, {2, 1}, {0, 2}, {0.5, 1}});
  expect_exact_from_all_sides({{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}});
}

TEST(Polygons, StraightCornersSpikesAndDoubleCornersLoseNothing) {
  expect_exact_from_all_sides({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 2}, {2, 1}, {1, 1}, {1, 3}, {0, 3}});
  expect_exact_from_all_sides({{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 9}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}});
  expect_exact_from_all_sides({{0, 0}, {3, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {2, 1}, {1, 1}, {1, 3}, {0, 3}, {0, 0}});
}

TEST(Polygons, HolesJoinedByBridgesStayOpen) {
  const Polygon window = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}};
  EXPECT_EQ(shoelace_area(window), 12);
  expect_exact_from_all_sides(window);
  // Two holes at one corner of the outline, the second touching the first.
  expect_exact_from_all_sides(
      {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {1, 2}, {1, 4}, {2, 3}, {1, 2}, {0, 0}, {2, 1}, {2, 3}, {4, 2}, {2, 1}});
  for (int count : {1, 2, 5, 40}) {
    expect_exact_from_all_sides(row_of_holes(count));
    expect_exact_from_all_sides(holes_around_corner(count));
  }
}

TEST(Polygons, AnySimplePolygonIsCoveredExactly) {
  lut::RandomStream random(7);
  for (std::size_t n = 4; n < 60; ++n) expect_exact_from_all_sides(ring(n, random));
  expect_exact(ring(3000, random), tilt());
  expect_exact_from_all_sides(comb(20));
  expect_exact_from_all_sides(spiral(60));
}

TEST(Polygons, WarpedOnesAreCutAsSeenAlongTheirNormal) {
  PolygonCutter cutter;
  std::vector<glm::dvec3> corners = {{0, 0, 0},    {3, 0, 0.2}, {3, 3, 0}, {2, 3, -0.3},
                                     {2, 1, 0.25}, {1, 1, 0},   {1, 3, 1}, {0, 3, 0}};
  const auto triangles = cutter.cut(corners);
  ASSERT_EQ(triangles.size(), 6u);
  for (const glm::uvec3& t : triangles) {
    EXPECT_GT(glm::cross(corners[t.y] - corners[t.x], corners[t.z] - corners[t.x]).z, 0);
  }
}

TEST(Polygons, WhatHasNoInsideStillGivesAllTriangles) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  PolygonCutter cutter;
  EXPECT_TRUE(cutter.cut(in_plane({{0, 0}, {1, 0}}, glm::dmat4(1))).empty());
  for (const Polygon& polygon :
       {Polygon(5), Polygon{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, Polygon{{0, 0}, {2, 0}, {1, 0}, {7, 0}, {3, 0}},
        Polygon{{0, 0}, {4, 0}, {1, nan}, {4, 4}, {1, 3}}, Polygon{{0, 0}, {4, 0}, {1, 1}, {infinity, 4}, {1, 3}},
        Polygon{{0, 0}, {1e300, 0}, {1e299, 1e299}, {0, 1e300}, {1e298, 1e298}},
        Polygon{{0, 0}, {5, 0}, {1, 4}, {2, -3}, {4, 4}, {0, 1}}}) {
    EXPECT_EQ(cutter.cut(in_plane(polygon, glm::dmat4(1))).size(), polygon.size() - 2);
  }
}

// Each of these took minutes where every corner is tried against every other.
TEST(Polygons, LargeOnesTakeNoLongerThanTheyMust) {
  constexpr int kCount = tests::unless_sanitized(200'000, 50'000);
  lut::RandomStream random(3);
  Polygon scribble, star;
  for (int i = 0; i < kCount; ++i) scribble.emplace_back(random.next_below(10000), random.next_below(10000));
  for (int i = 0; i < kCount; ++i) {
    star.emplace_back(i % 2 == 0 ? glm::dvec2(0) : glm::dvec2(random.next_below(10000), random.next_below(10000)));
  }
  expect_exact(ring(kCount, random));
  expect_exact(comb(kCount / 2));
  expect_exact(spiral(kCount / 2));
  PolygonCutter cutter;
  EXPECT_EQ(cutter.cut(in_plane(scribble, glm::dmat4(1))).size(), scribble.size() - 2);
  EXPECT_EQ(cutter.cut(in_plane(star, glm::dmat4(1))).size(), star.size() - 2);
}

TEST(Polygons, NormalsFollowTheirCorners) {
  FileMesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.5, 1, 0}};
  mesh.add_polygon(std::vector<std::uint32_t>{0, 1, 2, 3}, std::vector<std::uint32_t>{10, 11, 12, 13});
  cut_polygons(mesh);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  for (std::size_t t = 0; t < 2; ++t) EXPECT_EQ(mesh.normal_corners.at(t), mesh.triangles[t] + 10u);
}

}  // namespace
}  // namespace lkao::scene
