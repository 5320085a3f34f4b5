#include "bvh/shaft.h"

#include <gtest/gtest.h>
#include <glm/common.hpp>

#include "support/meshes.h"

namespace lkao::bvh {
namespace {

Bounds some_box(lut::RandomStream& random) {
  const glm::vec3 center = tests::random_point(random, 10), half = glm::abs(tests::random_point(random, 3));
  return {center - half, center + half};
}

glm::vec3 point_in(const Bounds& box, lut::RandomStream& random) {
  return glm::mix(box.lower, box.upper, 0.5f + 0.5f * tests::random_point(random, 1));
}

TEST(Shaft, TellsWhatLiesBesideIt) {
  const Shaft shaft({{-1, -1, 0}, {1, 1, 0}}, {{9, -1, 10}, {11, 1, 10}});
  const Bounds boxes[kWidth - 1] = {{{4, -1, 4}, {5, 1, 5}},      {{-1, -1, 8}, {1, 1, 9}}, {{4, 2, 4}, {5, 3, 5}},
                                    {{9, -1, 11}, {11, 1, 12}},   {{9, -1, 1}, {9, 1, 2}},  {{-9, -9, -9}, {99, 9, 9}},
                                    {{0.9f, 0, -1}, {2, 0, 0.1f}}};
  Node node = Node::empty();
  for (int i = 0; i < kWidth - 1; ++i) node.set_child(i, boxes[i], ChildRef::leaf(0));
  EXPECT_EQ(shaft.met_children(node), 0b1100001u);
}

// A box around a point of a segment from one box to the other is met, wherever they are.
TEST(Shaft, NoSegmentLeavesIt) {
  lut::RandomStream random(5);
  int left_out = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Bounds origins = some_box(random), ends = some_box(random);
    const Shaft shaft(origins, ends);
    Node node = Node::empty();
    for (int child = 0; child < 4; ++child) {
      const glm::vec3 from = point_in(origins, random), to = point_in(ends, random);
      const glm::vec3 point = glm::mix(from, to, 0.5f + 0.5f * tests::random_point(random, 1).x);
      node.set_child(child, {point, point}, ChildRef::leaf(0));
    }
    for (int child = 4; child < kWidth; ++child) node.set_child(child, some_box(random), ChildRef::leaf(0));
    const std::uint32_t met = shaft.met_children(node);
    ASSERT_EQ(met & 0xfu, 0xfu) << "shaft " << i;
    left_out += met != 0xffu;
  }
  EXPECT_GT(left_out, 1000);
}

}  // namespace
}  // namespace lkao::bvh
