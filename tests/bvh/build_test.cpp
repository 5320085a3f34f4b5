#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "layout_walk.h"
#include "lkao/ambient_occlusion.h"
#include "support/meshes.h"

namespace lkao {
namespace {

using tests::LayoutWalk;
using tests::Mesh;

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
  EXPECT_EQ(LayoutWalk(occluders.layout()).primitives(), std::vector<std::uint32_t>{0});
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

// No plane can tell these apart: the builder must give up on good splits, not recurse for ever.
TEST(OccluderBvh, TakesManyEqualTriangles) {
  Mesh mesh;
  mesh.positions = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  mesh.triangles.assign(5000, {0, 1, 2});
  const OccluderBvh occluders(mesh.view());
  EXPECT_EQ(LayoutWalk(occluders.layout()).primitives().size(), 5000u);
}

}  // namespace
}  // namespace lkao
