#include "bvh/triangle_clip.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "support/meshes.h"

namespace lkao::bvh {
namespace {

bool holds(const Bounds& box, const glm::dvec3& point) {
  return glm::all(glm::lessThanEqual(glm::dvec3(box.lower), point)) &&
         glm::all(glm::lessThanEqual(point, glm::dvec3(box.upper)));
}

TEST(TriangleClip, CutsAKnownTriangle) {
  const glm::vec3 corners[3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const SplitBounds split = clip_triangle(corners, {{0, 0, 0}, {4, 4, 0}}, 0, 1.0f);
  EXPECT_EQ(split.left.lower, glm::vec3(0, 0, 0));
  EXPECT_EQ(split.left.upper, glm::vec3(1, 4, 0));
  EXPECT_EQ(split.right.lower, glm::vec3(1, 0, 0));
  EXPECT_EQ(split.right.upper.x, 4);
  EXPECT_NEAR(split.right.upper.y, 3, 1e-6);
}

TEST(TriangleClip, PlaneThroughACornerBelongsToBothSides) {
  const glm::vec3 corners[3] = {{1, 0, 0}, {4, 0, 0}, {1, 4, 0}};
  const SplitBounds split = clip_triangle(corners, {{1, 0, 0}, {4, 4, 0}}, 0, 1.0f);
  EXPECT_EQ(split.left.upper, glm::vec3(1, 4, 0));
  EXPECT_EQ(split.right.upper, glm::vec3(4, 4, 0));
}

// Split again and again, as the builder does: every point of the triangle stays in the piece of its side, and pieces
// stay within what was split.
TEST(TriangleClip, LosesNoPointOfTheTriangle) {
  lut::RandomStream random(31);
  for (int i = 0; i < 20'000; ++i) {
    glm::vec3 corners[3];
    const glm::vec3 offset = tests::random_point(random, 1) * std::pow(10.0f, tests::uniform(random, -1, 4));
    for (glm::vec3& corner : corners) corner = offset + tests::random_point(random, 1);
    Bounds piece{glm::min(corners[0], glm::min(corners[1], corners[2])),
                 glm::max(corners[0], glm::max(corners[1], corners[2]))};
    // A point inside; the piece that holds it must go on holding it.
    double u = random.next_double(), v = random.next_double();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const glm::dvec3 a(corners[0]), b(corners[1]), c(corners[2]);
    const glm::dvec3 point = a + u * (b - a) + v * (c - a);
    for (int cut = 0; cut < 8; ++cut) {
      const int axis = static_cast<int>(random.next_below(3));
      const float position = tests::uniform(random, piece.lower[axis], piece.upper[axis]);
      const SplitBounds split = clip_triangle(corners, piece, axis, position);
      for (const Bounds& side : {split.left, split.right}) {
        for (int k = 0; k < 3; ++k) {
          if (side.lower[k] > side.upper[k]) continue;  // an empty side
          ASSERT_GE(side.lower[k], piece.lower[k]);
          ASSERT_LE(side.upper[k], piece.upper[k]);
        }
      }
      const bool left = point[axis] <= static_cast<double>(position);
      ASSERT_TRUE(holds(left ? split.left : split.right, point)) << i << " cut " << cut;
      piece = left ? split.left : split.right;
    }
  }
}

}  // namespace
}  // namespace lkao::bvh
