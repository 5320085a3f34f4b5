#include "bvh/triangle_clip.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "support/meshes.h"

namespace lkao::bvh {
namespace {

struct Split {
  Bounds left, right;
};

Bounds bounds_of(const Box& b) { return {{b.lower[0], b.lower[1], b.lower[2]}, {b.upper[0], b.upper[1], b.upper[2]}}; }

// One triangle, to be cut.
class Cutter {
 public:
  explicit Cutter(const glm::vec3 (&corners)[3]) : mesh_{{corners[0], corners[1], corners[2]}, {{0, 1, 2}}} {}

  Split clip(const Bounds& piece, int axis, float position) {
    const Box box{{piece.lower.x, piece.lower.y, piece.lower.z, 0}, {piece.upper.x, piece.upper.y, piece.upper.z, 0}};
    const auto [left, right] = cut_triangle(mesh_, 0, box, axis, position);
    return {bounds_of(left), bounds_of(right)};
  }

 private:
  PackedMesh mesh_;
};

Split clip(const glm::vec3 (&corners)[3], const Bounds& piece, int axis, float position) {
  return Cutter(corners).clip(piece, axis, position);
}

Bounds bounds_of(const glm::vec3 (&corners)[3]) {
  return {glm::min(corners[0], glm::min(corners[1], corners[2])),
          glm::max(corners[0], glm::max(corners[1], corners[2]))};
}

bool holds(const Bounds& box, const glm::dvec3& point) {
  return glm::all(glm::lessThanEqual(glm::dvec3(box.lower), point)) &&
         glm::all(glm::lessThanEqual(point, glm::dvec3(box.upper)));
}

bool is_empty(const Bounds& box) { return glm::any(glm::greaterThan(box.lower, box.upper)); }

bool is_inside(const Bounds& inner, const Bounds& outer) {
  return is_empty(inner) || (holds(outer, inner.lower) && holds(outer, inner.upper));
}

TEST(TriangleClip, CutsAKnownTriangle) {
  const glm::vec3 corners[3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const Split split = clip(corners, {{0, 0, 0}, {4, 4, 0}}, 0, 1.0f);
  EXPECT_EQ(split.left.lower, glm::vec3(0, 0, 0));
  EXPECT_EQ(split.left.upper, glm::vec3(1, 4, 0));
  EXPECT_EQ(split.right.lower, glm::vec3(1, 0, 0));
  EXPECT_EQ(split.right.upper.x, 4);
  EXPECT_NEAR(split.right.upper.y, 3, 1e-5);
  EXPECT_GE(split.right.upper.y, 3);
}

TEST(TriangleClip, CutsTheSameInAnyOrderOfCorners) {
  const glm::vec3 a(0, 1, 5), b(3, 0, 7), c(2, 4, 6);
  const Bounds whole{{0, 0, 5}, {3, 4, 7}};
  for (const float position : {1.0f, 2.0f, 2.5f}) {
    const Split expected = clip({a, b, c}, whole, 0, position);
    EXPECT_EQ(expected.left.upper.x, position);
    EXPECT_EQ(expected.right.lower.x, position);
    for (const auto& [d, e, f] : {std::tuple(b, c, a), std::tuple(c, a, b), std::tuple(c, b, a), std::tuple(a, c, b)}) {
      const Split split = clip({d, e, f}, whole, 0, position);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(split.left.lower[axis], expected.left.lower[axis], 1e-5);
        EXPECT_NEAR(split.left.upper[axis], expected.left.upper[axis], 1e-5);
        EXPECT_NEAR(split.right.lower[axis], expected.right.lower[axis], 1e-5);
        EXPECT_NEAR(split.right.upper[axis], expected.right.upper[axis], 1e-5);
      }
    }
  }
}

TEST(TriangleClip, TriangleBesideThePlaneStaysWhole) {
  const glm::vec3 corners[3] = {{1, 0, 0}, {4, 0, 0}, {1, 4, 0}};
  const Bounds whole = bounds_of(corners);
  for (const float position : {0.0f, 1.0f}) {
    const Split split = clip(corners, whole, 0, position);
    EXPECT_TRUE(is_empty(split.left)) << position;
    EXPECT_EQ(split.right.lower, whole.lower) << position;
    EXPECT_EQ(split.right.upper, whole.upper) << position;
  }
  for (const float position : {4.0f, 5.0f}) {
    const Split split = clip(corners, whole, 0, position);
    EXPECT_TRUE(is_empty(split.right)) << position;
    EXPECT_EQ(split.left.lower, whole.lower) << position;
    EXPECT_EQ(split.left.upper, whole.upper) << position;
  }
}

TEST(TriangleClip, PlaneThroughACornerCutsThere) {
  const glm::vec3 corners[3] = {{0, 0, 0}, {2, 6, 0}, {4, 0, 0}};
  const Split split = clip(corners, bounds_of(corners), 0, 2.0f);
  EXPECT_EQ(split.left.upper, glm::vec3(2, 6, 0));
  EXPECT_EQ(split.right.lower, glm::vec3(2, 0, 0));
  EXPECT_EQ(split.right.upper, glm::vec3(4, 6, 0));
}

TEST(TriangleClip, CutsEachTriangleOfAMesh) {
  const PackedMesh mesh{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 8, 0}}, {{0, 1, 2}, {0, 1, 3}}};
  for (const std::uint32_t primitive : {0u, 1u, 0u}) {
    const float height = primitive == 0 ? 4.0f : 8.0f;
    for (const int axis : {0, 1}) {
      const auto [left, right] = cut_triangle(mesh, primitive, Box{{0, 0, 0, 0}, {4, height, 0, 0}}, axis, 2);
      EXPECT_NEAR(right.upper[0], axis == 0 ? 4 : 4 - 8 / height, 1e-5);
      EXPECT_NEAR(right.upper[1], axis == 0 ? height / 2 : height, 1e-5);
    }
  }
}

// A triangle somewhere, large or small, near the origin or far from it.
struct Case {
  explicit Case(lut::RandomStream& random) {
    const float scale = std::pow(10.0f, tests::uniform(random, -6, 6));
    const glm::vec3 offset = tests::random_point(random, scale) * std::pow(10.0f, tests::uniform(random, -2, 3));
    for (glm::vec3& corner : corners) corner = offset + tests::random_point(random, scale);
    if (random.next_below(4) == 0) corners[1].y = corners[0].y;  // an edge along planes
    if (random.next_below(4) == 0) corners[2].z = corners[1].z = corners[0].z;
  }
  glm::vec3 corners[3];
};

glm::dvec3 random_point_inside(const glm::vec3 (&corners)[3], lut::RandomStream& random) {
  double u = random.next_double(), v = random.next_double();
  if (u + v > 1) u = 1 - u, v = 1 - v;
  if (random.next_below(4) == 0) u = 0;  // on an edge
  const glm::dvec3 a(corners[0]), b(corners[1]), c(corners[2]);
  return a + u * (b - a) + v * (c - a);
}

// Split again and again, as the builder does: every point of the triangle stays in the piece of its side, and pieces
// stay within what was split.
TEST(TriangleClip, LosesNoPointOfTheTriangle) {
  lut::RandomStream random(31);
  int cut_count = 0;
  for (int i = 0; i < 50'000; ++i) {
    const Case t(random);
    Bounds piece = bounds_of(t.corners);
    Cutter cutter(t.corners);
    const glm::dvec3 point = random_point_inside(t.corners, random);
    if (!holds(piece, point)) continue;  // rounding of the test's own
    for (int cut = 0; cut < 8; ++cut) {
      const int axis = static_cast<int>(random.next_below(3));
      const float position = tests::uniform(random, piece.lower[axis], piece.upper[axis]);
      const Split split = cutter.clip(piece, axis, position);
      ASSERT_TRUE(is_inside(split.left, piece) && is_inside(split.right, piece)) << i << " cut " << cut;
      const bool is_left = point[axis] < static_cast<double>(position);
      const bool is_right = point[axis] > static_cast<double>(position);
      ASSERT_TRUE(is_right || is_left || holds(split.left, point) || holds(split.right, point)) << i << " cut " << cut;
      ASSERT_TRUE(!is_left || holds(split.left, point)) << i << " cut " << cut;
      ASSERT_TRUE(!is_right || holds(split.right, point)) << i << " cut " << cut;
      piece = holds(split.left, point) ? split.left : split.right;
      ++cut_count;
    }
  }
  EXPECT_GT(cut_count, 200'000);
}

// Room for rounding is not more than some steps of a float: otherwise spatial splits would gain nothing.
TEST(TriangleClip, BoxesAreTight) {
  lut::RandomStream random(32);
  for (int i = 0; i < 20'000; ++i) {
    const Case t(random);
    const Bounds whole = bounds_of(t.corners);
    const int axis = static_cast<int>(random.next_below(3));
    const float position = tests::uniform(random, whole.lower[axis], whole.upper[axis]);
    const Split split = clip(t.corners, whole, axis, position);
    // The exact box of the left part, in double.
    glm::dvec3 lower(1e30), upper(-1e30);
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 from(t.corners[k]), to(t.corners[(k + 1) % 3]);
      const double plane = static_cast<double>(position);
      if (from[axis] <= plane) lower = glm::min(lower, from), upper = glm::max(upper, from);
      if ((from[axis] < plane) == (to[axis] < plane)) continue;
      const glm::dvec3 crossing = from + (plane - from[axis]) / (to[axis] - from[axis]) * (to - from);
      lower = glm::min(lower, crossing), upper = glm::max(upper, crossing);
    }
    if (is_empty(split.left)) continue;
    for (int k = 0; k < 3; ++k) {
      const double size =
          std::max(std::abs(static_cast<double>(whole.lower[k])), std::abs(static_cast<double>(whole.upper[k])));
      ASSERT_GE(static_cast<double>(split.left.lower[k]), lower[k] - 0x1p-19 * size - 1e-18) << i;
      ASSERT_LE(static_cast<double>(split.left.upper[k]), upper[k] + 0x1p-19 * size + 1e-18) << i;
    }
  }
}

}  // namespace
}  // namespace lkao::bvh
