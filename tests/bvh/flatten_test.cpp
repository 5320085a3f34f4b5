// The layout that comes out of a build. The walk itself checks its shape.
#include "bvh/flatten.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "equal_layouts.h"
#include "layout_walk.h"
#include "support/laid_out.h"
#include "support/meshes.h"

namespace lkao::bvh {
namespace {

using tests::expect_equal;
using tests::LaidOut;
using tests::LayoutWalk;
using tests::Mesh;

Mesh scaled(Mesh mesh, float scale) {
  for (glm::vec3& position : mesh.positions) position *= scale;
  return mesh;
}

// Number of triangles, their size, the scale of the scene, spatial splits.
class FlattenedSoup : public testing::TestWithParam<std::tuple<int, float, float, bool>> {
 protected:
  int count() const { return std::get<0>(GetParam()); }
  bool has_splits() const { return std::get<3>(GetParam()); }
  Mesh mesh = scaled(tests::random_soup(count(), std::get<1>(GetParam()), 41), std::get<2>(GetParam()));
  OccluderBvh occluders{mesh.view(), {.spatial_splits = has_splits()}};
  LayoutWalk walk{occluders.layout()};
};

INSTANTIATE_TEST_SUITE_P(Sizes, FlattenedSoup,
                         testing::Combine(testing::Values(1, 2, 7, 8, 9, 64, 5000), testing::Values(0.01f, 0.5f),
                                          testing::Values(1e-6f, 1.0f, 1e6f), testing::Bool()));

TEST_P(FlattenedSoup, HoldsEveryOccluder) {
  EXPECT_EQ(walk.primitives().size(), static_cast<std::size_t>(count()));
  EXPECT_EQ(walk.references.size(), occluders.report().reference_count);
  if (!has_splits()) {
    EXPECT_EQ(walk.references.size(), static_cast<std::size_t>(count()));
  }
}

TEST_P(FlattenedSoup, ReportsItsSize) {
  const BuildReport& report = occluders.report();
  EXPECT_EQ(walk.node_count, report.node_count);
  EXPECT_EQ(walk.node_count, occluders.layout().nodes.size());
  EXPECT_EQ(walk.leaf_count, occluders.layout().leaves.size());
  EXPECT_LE(walk.depth, kMaxDepth);
  EXPECT_EQ(report.memory_bytes, walk.node_count * sizeof(Node) + walk.leaf_count * sizeof(Leaf) +
                                     mesh.positions.size() * sizeof(glm::vec3) +
                                     mesh.triangles.size() * sizeof(glm::uvec3));
}

// A step of float, and kMargin.
bool is_well_inside(const glm::dvec3& point, const Bounds& box) {
  for (int axis = 0; axis < 3; ++axis) {
    const float lower = std::nextafter(box.lower[axis], INFINITY), upper = std::nextafter(box.upper[axis], -INFINITY);
    if (point[axis] < static_cast<double>(lower) || point[axis] > static_cast<double>(upper)) return false;
    const double margin = std::min(point[axis] - static_cast<double>(box.lower[axis]),
                                   static_cast<double>(box.upper[axis]) - point[axis]);
    if (margin < 0.999 * static_cast<double>(Node::kMargin)) return false;
  }
  return true;
}

// Pieces of a triangle that was split cover it together.
TEST_P(FlattenedSoup, BoxesHoldEveryPointWithAMargin) {
  std::map<std::uint32_t, std::vector<Bounds>> boxes;
  for (const LayoutWalk::Reference& reference : walk.references) boxes[reference.primitive].push_back(reference.box);
  lut::RandomStream random(42);
  for (const auto& [primitive, pieces] : boxes) {
    const glm::uvec3& t = mesh.triangles[primitive];
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    for (int i = 0; i < 20; ++i) {
      double u = random.next_double(), v = random.next_double();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      if (i < 3) u = i == 1, v = i == 2;  // the corners
      const glm::dvec3 point = a + u * (b - a) + v * (c - a);
      EXPECT_TRUE(
          std::any_of(pieces.begin(), pieces.end(), [&](const Bounds& box) { return is_well_inside(point, box); }))
          << "triangle " << primitive << " at " << u << ", " << v;
    }
  }
}

// Worth splitting.
Mesh long_slivers(int count) {
  Mesh mesh = tests::random_soup(count, 1.0f, 43);
  for (const glm::uvec3& t : mesh.triangles) {
    mesh.positions[t.z] = mesh.positions[t.x] + 1e-3f * (mesh.positions[t.z] - mesh.positions[t.x]);
  }
  return mesh;
}

// Half the surface of the leaf that a reference lies in, on average.
double mean_leaf_area(const Layout& layout) {
  double sum = 0;
  const LayoutWalk walk(layout);
  for (const LayoutWalk::Reference& reference : walk.references) {
    const glm::dvec3 size = glm::dvec3(reference.box.upper) - glm::dvec3(reference.box.lower);
    sum += size.x * size.y + size.y * size.z + size.z * size.x;
  }
  return sum / static_cast<double>(walk.references.size());
}

TEST(SpatialSplits, MakeTheBoxesOfSliversSmaller) {
  const Mesh mesh = long_slivers(2000);
  const OccluderBvh whole(mesh.view(), {.spatial_splits = false}), split(mesh.view(), {.spatial_splits = true});
  EXPECT_LT(mean_leaf_area(split.layout()), 0.9 * mean_leaf_area(whole.layout()));
  EXPECT_LE(split.report().reference_count, mesh.triangles.size() * 2);
}

template <typename Index>
void expect_same_from(const Mesh& mesh) {
  const OccluderBvh packed(mesh.view());
  for (const auto& [offset, gap] : {std::pair(0, 0), std::pair(0, 4), std::pair(12, 20), std::pair(1, 3)}) {
    const LaidOut<Index> laid_out(mesh, static_cast<std::size_t>(offset), static_cast<std::size_t>(gap));
    const OccluderBvh other(laid_out.view());
    expect_equal(packed.layout().nodes, other.layout().nodes);
    expect_equal(packed.layout().leaves, other.layout().leaves);
    EXPECT_EQ(packed.layout().mesh.positions, other.layout().mesh.positions);
    EXPECT_EQ(packed.layout().mesh.triangles, other.layout().mesh.triangles);
  }
}

TEST(Flatten, GivesTheSameFromAnyLayoutOfTheMesh) {
  const Mesh mesh = long_slivers(3000);
  expect_same_from<std::uint16_t>(mesh);
  expect_same_from<std::uint32_t>(mesh);
  expect_same_from<std::int32_t>(mesh);
}

TEST(Flatten, GivesTheSameOnAnyNumberOfThreads) {
  const tbb::global_control more_threads(tbb::global_control::max_allowed_parallelism, 8);
  const Mesh mesh = long_slivers(20'000);  // enough for parallel work at every step
  for (const bool splits : {false, true}) {
    const auto build = [&](int thread_count) {
      return tbb::task_arena(thread_count).execute([&] {
        return OccluderBvh(mesh.view(), {.spatial_splits = splits});
      });
    };
    const OccluderBvh single = build(1);
    EXPECT_EQ(single.report().reference_count > mesh.triangles.size() * 11 / 10, splits);
    for (const int thread_count : {2, 8, 8}) {
      const OccluderBvh other = build(thread_count);
      expect_equal(single.layout().nodes, other.layout().nodes);
      expect_equal(single.layout().leaves, other.layout().leaves);
    }
  }
}

}  // namespace
}  // namespace lkao::bvh
