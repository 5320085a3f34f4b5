#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <glm/vector_relational.hpp>

#include "bvh/layout.h"
#include "lkao/ambient_occlusion.h"
#include "support/meshes.h"

namespace lkao {
namespace {

using tests::Mesh;

bool within(const Bounds& inner, const Bounds& outer) {
  return glm::all(glm::greaterThanEqual(inner.lower, outer.lower)) &&
         glm::all(glm::lessThanEqual(inner.upper, outer.upper));
}

// Walks the hierarchy and checks what must hold of any: boxes nest, no child is shared, leaves hold what they should.
class Walk {
 public:
  explicit Walk(const bvh::Layout& layout) : layout_(layout) {
    if (!layout.nodes.empty()) visit(0, {layout.bounds.lower - 1e-5f, layout.bounds.upper + 1e-5f});
  }
  std::set<std::uint32_t> primitives, nodes, leaves;

 private:
  void visit(std::uint32_t index, const Bounds& box) {
    EXPECT_TRUE(nodes.insert(index).second) << "node " << index << " has two parents";
    const bvh::Node& node = layout_.nodes[index];
    bool ended = false;
    for (int i = 0; i < bvh::kWidth; ++i) {
      if (node.children[i].is_empty()) {
        ended = true;
        continue;
      }
      EXPECT_FALSE(ended) << "a child behind an empty one";
      EXPECT_TRUE(within(node.child_bounds(i), box)) << "node " << index << " child " << i;
      if (node.children[i].is_leaf()) {
        visit_leaf(node.children[i].index());
      } else {
        visit(node.children[i].index(), node.child_bounds(i));
      }
    }
  }
  void visit_leaf(std::uint32_t index) {
    EXPECT_TRUE(leaves.insert(index).second) << "leaf " << index << " has two parents";
    for (std::uint32_t primitive : layout_.leaves[index].primitives) {
      if (primitive != kNoPrimitive) primitives.insert(primitive);
    }
  }
  const bvh::Layout& layout_;
};

TEST(OccluderBvh, EmptyMeshBlocksNothing) {
  const OccluderBvh occluders{TriangleMesh{}};
  EXPECT_EQ(occluders.report().occluder_count, 0u);
  EXPECT_GT(occluders.bounds().lower.x, occluders.bounds().upper.x);
  const AmbientOcclusion ao(occluders, SamplePattern::standard(64), {.radius = 1});
  EXPECT_EQ(ao.query({.position = {0, 0, 0}, .normal = {0, 0, 1}}, 0).occlusion, 0.0f);
}

TEST(OccluderBvh, CountsAndDropsBadTriangles) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {kNaN, 0, 0}, {0, INFINITY, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 0, 1}, {0, 1, 4}, {0, 1, 5}};
  const OccluderBvh occluders(mesh.view());
  EXPECT_EQ(occluders.report().triangle_count, 5u);
  EXPECT_EQ(occluders.report().occluder_count, 1u);
  EXPECT_EQ(occluders.report().zero_area_count, 2u);
  EXPECT_EQ(occluders.report().non_finite_count, 2u);
  EXPECT_EQ(occluders.bounds().upper, glm::vec3(1, 1, 0));
  EXPECT_EQ(Walk(occluders.layout()).primitives, std::set<std::uint32_t>{0});
}

TEST(OccluderBvh, NamesAnIndexOutOfRange) {
  Mesh mesh = tests::closed_box();
  mesh.triangles[5].y = 8;
  try {
    OccluderBvh{mesh.view()};
    FAIL() << "an index out of range was taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()), "triangle 5 has index 8, but there are 8 positions");
  }
}

class OccluderBvhOfSoup : public testing::TestWithParam<std::tuple<int, float, bool>> {};

INSTANTIATE_TEST_SUITE_P(Sizes, OccluderBvhOfSoup,
                         testing::Combine(testing::Values(1, 2, 7, 8, 9, 64, 5000), testing::Values(0.01f, 0.5f),
                                          testing::Bool()));

TEST_P(OccluderBvhOfSoup, HoldsEveryOccluderInNestedBoxes) {
  const auto [count, size, splits] = GetParam();
  const Mesh mesh = tests::random_soup(count, size, 41);
  const OccluderBvh occluders(mesh.view(), {.spatial_splits = splits});
  const Walk walk(occluders.layout());
  EXPECT_EQ(walk.primitives.size(), static_cast<std::size_t>(count));
  EXPECT_EQ(walk.nodes.size(), occluders.report().node_count);
  EXPECT_EQ(walk.leaves.size(), occluders.layout().leaves.size());
  EXPECT_GE(occluders.report().reference_count, static_cast<std::size_t>(count));
  if (!splits) {
    EXPECT_EQ(occluders.report().reference_count, static_cast<std::size_t>(count));
  }
  EXPECT_GT(occluders.report().memory_bytes, 0u);
}

// No plane can tell these apart: the builder must give up on good splits, not recurse for ever.
TEST(OccluderBvh, TakesManyEqualTriangles) {
  Mesh mesh;
  mesh.positions = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  mesh.triangles.assign(5000, {0, 1, 2});
  const OccluderBvh occluders(mesh.view());
  EXPECT_EQ(Walk(occluders.layout()).primitives.size(), 5000u);
}

}  // namespace
}  // namespace lkao
