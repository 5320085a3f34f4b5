#include "bvh/ray_box.h"

#include <cmath>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "support/meshes.h"

namespace lkao::bvh {
namespace {

// Some components exactly zero, as for rays along an axis.
glm::vec3 some_zeros(glm::vec3 v, lut::RandomStream& random) {
  for (int axis = 0; axis < 3; ++axis) {
    if (random.next_below(4) == 0) v[axis] = 0;
  }
  return v;
}

// As the builder makes the boxes of nodes.
Bounds a_step_larger(const Bounds& box) {
  constexpr float kTiny = std::numeric_limits<float>::min();
  Bounds larger;
  for (int axis = 0; axis < 3; ++axis) {
    larger.lower[axis] = std::min(std::nextafter(box.lower[axis], -INFINITY), box.lower[axis] - kTiny);
    larger.upper[axis] = std::max(std::nextafter(box.upper[axis], INFINITY), box.upper[axis] + kTiny);
  }
  return larger;
}

TEST(BoxTest, TellsHitFromMiss) {
  const Bounds box{{1, -1, -1}, {2, 1, 1}};
  EXPECT_TRUE(may_meet(BoxRay({3, 0, 0}), glm::vec3(0), box));
  EXPECT_TRUE(may_meet(BoxRay({1, 0, 0}), glm::vec3(0), box)) << "ends on the face";
  EXPECT_FALSE(may_meet(BoxRay({0.99f, 0, 0}), glm::vec3(0), box));
  EXPECT_FALSE(may_meet(BoxRay({-3, 0, 0}), glm::vec3(0), box));
  EXPECT_FALSE(may_meet(BoxRay({3, 4, 0}), glm::vec3(0), box));
  EXPECT_TRUE(may_meet(BoxRay({0, 0, 0.1f}), {1.5f, 0, 0}, box)) << "starts inside";
}

// A ray that ends at, or passes, a point of the box must be kept: at any scale and offset, with flat boxes, rays along
// axes, and origins in the plane of a face.
TEST(BoxTest, NeverDropsAHit) {
  lut::RandomStream random(21);
  int hit_count = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    const float scale = std::pow(10.0f, tests::uniform(random, -6, 6));
    const glm::vec3 offset = tests::random_point(random, 1) * scale * std::pow(10.0f, tests::uniform(random, -2, 3));
    const glm::vec3 center = offset + tests::random_point(random, 1) * scale;
    const glm::vec3 half = glm::abs(some_zeros(tests::random_point(random, 1), random)) * scale * 0.3f;
    const Bounds held{center - half, center + half}, box = a_step_larger(held);
    // A point of what the box holds, often on its faces.
    glm::vec3 target;
    for (int axis = 0; axis < 3; ++axis) {
      const auto where = random.next_below(4);
      target[axis] = where == 0   ? held.lower[axis]
                     : where == 1 ? held.upper[axis]
                                  : glm::clamp(tests::uniform(random, held.lower[axis], held.upper[axis]),
                                               held.lower[axis], held.upper[axis]);
    }
    // The segment, in the float arithmetic of a ray, passes the target at 1 / stretch to rounding; that rounding is the
    // test's own, so the target is computed back from the ray.
    const glm::vec3 origin = target - some_zeros(tests::random_point(random, 1), random) * scale;
    const float stretch = random.next_below(2) == 0 ? 1.0f : tests::uniform(random, 1, 3);
    const glm::vec3 ray = (target - origin) * stretch;
    bool hits = true;
    const glm::dvec3 reached = glm::dvec3(origin) + glm::dvec3(ray) / static_cast<double>(stretch);
    for (int axis = 0; axis < 3; ++axis) hits &= reached[axis] >= held.lower[axis] && reached[axis] <= held.upper[axis];
    if (!hits) continue;
    ++hit_count;
    ASSERT_TRUE(may_meet(BoxRay(ray), origin, box)) << i;
  }
  EXPECT_GT(hit_count, 100'000);
}

TEST(BoxTest, OutOfReachIsFarOrBelow) {
  const Bounds box{{1, 1, 1}, {2, 2, 2}};
  const glm::vec3 up(0, 1, 0);
  EXPECT_FALSE(is_out_of_reach(box, glm::vec3(0), up, 0, 1.7321f));
  EXPECT_TRUE(is_out_of_reach(box, glm::vec3(0), up, 0, 1.73f));
  EXPECT_FALSE(is_out_of_reach(box, {0, 1.99f, 0}, up, 0, 10));
  EXPECT_TRUE(is_out_of_reach(box, {0, 2.01f, 0}, up, 0, 10));
  EXPECT_FALSE(is_out_of_reach(box, {0, 2, 0}, up, 0, 10)) << "touches the horizon";
  EXPECT_FALSE(is_out_of_reach(box, {1.5f, 1.5f, 1.5f}, up, 0, 1e-3f)) << "origin inside";
}

}  // namespace
}  // namespace lkao::bvh
