#include "bvh/box_outline.h"

#include <gtest/gtest.h>

#include "support/meshes.h"

namespace lkao::bvh {
namespace {

TEST(BoxOutline, HasFourOrSixEdgesOutsideAndNoneInside) {
  const Bounds box{glm::vec3(-1), glm::vec3(1)};
  EXPECT_EQ(BoxOutline(box, {0, 0, 0}).edge_count(), 0);
  EXPECT_EQ(BoxOutline(box, {0, 0, -3}).edge_count(), 4);
  EXPECT_EQ(BoxOutline(box, {0, 2, -3}).edge_count(), 6);
  EXPECT_EQ(BoxOutline(box, {2, 2, -3}).edge_count(), 6);
}

TEST(BoxOutline, SeesTheFacesTurnedToIt) {
  const BoxOutline outline({glm::vec3(-1), glm::vec3(1)}, {0, 3, -5});
  EXPECT_FALSE(outline.sees_face(0));
  EXPECT_EQ(outline.face_normal(1), glm::dvec3(0, -1, 0));
  EXPECT_EQ(outline.face_distance(1), 2);
  EXPECT_EQ(outline.face_normal(2), glm::dvec3(0, 0, 1));
  EXPECT_EQ(outline.face_distance(2), 4);
}

// Points of the box are beyond every plane; directions beyond every edge do meet the box.
TEST(BoxOutline, IsTheBoxAsSeen) {
  lut::RandomStream random(96);
  for (int i = 0; i < 20'000; ++i) {
    const glm::vec3 center = tests::random_point(random, 2), half = glm::abs(tests::random_point(random, 1));
    const Bounds box{center - half, center + half};
    const BoxOutline outline(box, glm::vec3(0));
    glm::dvec3 point;
    for (int axis = 0; axis < 3; ++axis) point[axis] = tests::uniform(random, box.lower[axis], box.upper[axis]);
    const glm::dvec3 direction(tests::random_direction(random));
    bool beyond_edges = true;
    for (int k = 0; k < outline.edge_count(); ++k) {
      ASSERT_GE(glm::dot(outline.edge(k), point), 0) << i;
      beyond_edges &= glm::dot(outline.edge(k), direction) >= 0;
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (!outline.sees_face(axis)) continue;
      ASSERT_GE(glm::dot(outline.face_normal(axis), point), outline.face_distance(axis)) << i;
    }
    // Does the line in this direction meet the box? By slabs, in double.
    double enter = 0, leave = 1e30;
    for (int axis = 0; axis < 3; ++axis) {
      const double t0 = static_cast<double>(box.lower[axis]) / direction[axis];
      const double t1 = static_cast<double>(box.upper[axis]) / direction[axis];
      enter = std::max(enter, std::min(t0, t1));
      leave = std::min(leave, std::max(t0, t1));
    }
    ASSERT_EQ(beyond_edges, enter <= leave) << i;
  }
}

}  // namespace
}  // namespace lkao::bvh
