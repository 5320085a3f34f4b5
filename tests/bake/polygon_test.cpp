#include "bake/polygon.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace lkao::bake {
namespace {

TEST(Polygon, ATriangleIsCutAtTheSidesOfATexel) {
  const Polygon triangle({glm::dvec2(0, 0), glm::dvec2(4, 0), glm::dvec2(0, 4)});
  EXPECT_EQ(triangle.area(), 8);
  EXPECT_LT(glm::distance(triangle.centroid(), glm::dvec2(4.0 / 3)), 1e-15);
  EXPECT_EQ(triangle.within({0, 0}, {1, 1}).area(), 1);
  EXPECT_EQ(triangle.within({0, 0}, {1, 1}).centroid(), glm::dvec2(0.5));
  EXPECT_EQ(triangle.within({2, 1}, {3, 2}).area(), 0.5);
  EXPECT_LT(glm::distance(triangle.within({2, 1}, {3, 2}).centroid(), glm::dvec2(2 + 1.0 / 3, 1 + 1.0 / 3)), 1e-15);
  EXPECT_EQ(triangle.within({2, 2}, {3, 3}).area(), 0);
  EXPECT_TRUE(triangle.within({3, 3}, {4, 4}).is_empty());
}

TEST(Polygon, AreaAndMiddleDoNotDependOnTheTurn) {
  const Polygon one({glm::dvec2(1, 2), glm::dvec2(5, 3), glm::dvec2(2, 7)});
  const Polygon other({glm::dvec2(1, 2), glm::dvec2(2, 7), glm::dvec2(5, 3)});
  EXPECT_EQ(one.area(), other.area());
  EXPECT_LT(glm::distance(one.centroid(), other.centroid()), 1e-14);
  EXPECT_NEAR(one.cut({1, 1}, 6).area() + one.cut({-1, -1}, -6).area(), one.area(), 1e-14);
}

}  // namespace
}  // namespace lkao::bake
