// Hierarchies whose triangles have moved, against those that are built where they are now.
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "equal_layouts.h"
#include "layout_walk.h"
#include "lkao/ambient_occlusion.h"
#include "support/brute_force.h"
#include "support/meshes.h"
#include "support/receivers.h"

namespace lkao {
namespace {

using tests::LayoutWalk;
using tests::Mesh;

constexpr RefitOptions kNeverAnew{.max_growth = std::numeric_limits<double>::infinity()};
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

// Every corner to a place of its own, not far away.
Mesh shaken(Mesh mesh, float distance, std::uint64_t seed) {
  lut::RandomStream random(seed);
  for (glm::vec3& p : mesh.positions) p += tests::random_point(random, distance);
  return mesh;
}

// The bits of some receivers in one row.
std::vector<std::uint64_t> masks(const AmbientOcclusion& ao) {
  const std::vector<Receiver> receivers = tests::with_exclusions(tests::random_receivers(40, 1.1f, 72), 5);
  std::vector<std::uint64_t> words(receivers.size() * static_cast<std::size_t>(ao.pattern().word_count()));
  ao.query(receivers, {.mask_words = words});
  return words;
}

std::vector<std::uint64_t> masks(const OccluderBvh& occluders, Kernel kernel = Kernel::simd) {
  return masks({occluders, SamplePattern::standard(64), {.radius = 0.8f}, kernel});
}

std::vector<std::uint64_t> brute_force_masks(const Mesh& mesh, const AmbientOcclusion& ao) {
  const std::vector<Receiver> receivers = tests::with_exclusions(tests::random_receivers(40, 1.1f, 72), 5);
  std::vector<std::uint64_t> words;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const ReceiverRays rays = ao.rays(receivers[i], i);
    const OcclusionMask mask =
        tests::brute_force_mask(mesh.view(), rays, ao.options(), receivers[i].excluded_primitive);
    words.insert(words.end(), mask.words, mask.words + ao.pattern().word_count());
  }
  return words;
}

// All that a query or a host can see: as of a hierarchy built from the mesh, and as without a hierarchy.
void expect_as_built_from(const Mesh& mesh, const OccluderBvh& refitted, bool spatial_splits = false) {
  const OccluderBvh built(mesh.view(), {.spatial_splits = spatial_splits});
  EXPECT_EQ(refitted.bounds().lower, built.bounds().lower);
  EXPECT_EQ(refitted.bounds().upper, built.bounds().upper);
  EXPECT_EQ(refitted.report().triangle_count, built.report().triangle_count);
  EXPECT_EQ(refitted.report().occluder_count, built.report().occluder_count);
  EXPECT_EQ(refitted.report().zero_area_count, built.report().zero_area_count);
  EXPECT_EQ(refitted.report().non_finite_count, built.report().non_finite_count);
  const LayoutWalk walk(refitted.layout()), walk_of_built(built.layout());
  EXPECT_EQ(walk.primitives(), walk_of_built.primitives());
  EXPECT_EQ(refitted.report().reference_count, walk.references.size());

  const AmbientOcclusion ao(built, SamplePattern::standard(64), {.radius = 0.8f});
  const std::vector<std::uint64_t> expected = brute_force_masks(mesh, ao);
  EXPECT_EQ(masks(ao), expected);
  EXPECT_EQ(masks(refitted, Kernel::simd), expected);
  EXPECT_EQ(masks(refitted, Kernel::scalar), expected);
  // Without end, where entry nodes are not told by distance.
  const AmbientOcclusion far(refitted, SamplePattern::standard(64), {.radius = INFINITY});
  EXPECT_EQ(masks(far), brute_force_masks(mesh, far));
}

class Refit : public testing::TestWithParam<bool> {
 protected:
  static bool splits() { return GetParam(); }
  static OccluderBvh build(const Mesh& mesh) { return OccluderBvh(mesh.view(), {.spatial_splits = splits()}); }
};

INSTANTIATE_TEST_SUITE_P(Splits, Refit, testing::Bool(),
                         [](const auto& splits) { return splits.param ? "SpatialSplits" : "WholeTriangles"; });

TEST_P(Refit, AnswersAsABuildFromTheNewPositions) {
  const Mesh mesh = tests::random_soup(300, 0.4f, 71);
  const OccluderBvh occluders = build(mesh);
  EXPECT_EQ(occluders.report().reference_count > mesh.triangles.size(), splits());
  for (const float distance : {0.0f, 0.1f, 2.0f}) {
    SCOPED_TRACE(distance);
    const Mesh moved = shaken(mesh, distance, 73);
    const OccluderBvh refitted = occluders.refitted(moved.positions, kNeverAnew);
    expect_as_built_from(moved, refitted, splits());
    EXPECT_EQ(refitted.report().node_count, occluders.report().node_count);
    EXPECT_EQ(refitted.report().memory_bytes, occluders.report().memory_bytes);
    EXPECT_EQ(masks(refitted) != masks(occluders), distance > 0);
  }
}

TEST_P(Refit, LeavesTheOldOneAsItWas) {
  const Mesh mesh = tests::random_soup(100, 0.4f, 74);
  const OccluderBvh occluders = build(mesh);
  const OccluderBvh refitted = occluders.refitted(shaken(mesh, 0.5f, 75).positions, kNeverAnew);
  EXPECT_NE(masks(refitted), masks(occluders));
  expect_as_built_from(mesh, occluders, splits());
  // And has forgotten nothing.
  expect_as_built_from(mesh, refitted.refitted(mesh.positions, kNeverAnew), splits());
}

// Some corners of a mesh are moved so that triangles block nothing.
Mesh damaged(Mesh mesh, std::size_t every) {
  for (std::size_t i = 0; i < mesh.triangles.size(); i += every) {
    const glm::uvec3& t = mesh.triangles[i];
    if (i % 3 == 0) mesh.positions[t.y] = mesh.positions[t.x];
    if (i % 3 == 1) mesh.positions[t.z] = {0, kNaN, 0};
    if (i % 3 == 2) mesh.positions[t.z] = {2e18f, 0, 0};
  }
  return mesh;
}

// Of some leaves all triangles, of others some.
TEST_P(Refit, LeavesOutTrianglesThatHaveBecomeUnusable) {
  const Mesh mesh = tests::random_soup(300, 0.4f, 76);
  const OccluderBvh occluders = build(mesh);
  OccluderBvh refitted = occluders;
  for (const std::size_t every : {50u, 4u, 1u, 7u, 2u}) {
    SCOPED_TRACE(every);
    const Mesh moved = damaged(shaken(mesh, 0.1f, every), every);
    refitted = refitted.refitted(moved.positions, kNeverAnew);
    expect_as_built_from(moved, refitted, splits());
    EXPECT_EQ(refitted.report().occluder_count == 0, every == 1);
    EXPECT_EQ(refitted.report().node_count, occluders.report().node_count);
  }
  // All come back.
  refitted = refitted.refitted(mesh.positions, kNeverAnew);
  expect_as_built_from(mesh, refitted, splits());
  EXPECT_EQ(refitted.report().reference_count, occluders.report().reference_count);
  EXPECT_TRUE(refitted.layout().resting.empty());
}

TEST_P(Refit, IsABuildWhereADroppedTriangleHasBecomeUsable) {
  const Mesh mesh = tests::random_soup(60, 0.4f, 77);
  for (const std::size_t every : {7u, 1u}) {  // some, or all
    const Mesh bad = damaged(mesh, every);
    const OccluderBvh occluders = build(bad);
    EXPECT_LT(occluders.report().occluder_count, 60u);
    // They stay unusable, if for another reason.
    Mesh moved = shaken(mesh, 0.1f, 78);
    for (std::size_t i = 0; i < 60; i += every) moved.positions[moved.triangles[i].x] = glm::vec3(kNaN);
    const OccluderBvh refitted = occluders.refitted(moved.positions, kNeverAnew);
    expect_as_built_from(moved, refitted, splits());
    EXPECT_EQ(refitted.report().node_count, occluders.report().node_count);
    // One of them does not.
    moved.positions[moved.triangles[0].x] = mesh.positions[mesh.triangles[0].x];
    const OccluderBvh built = refitted.refitted(moved.positions, kNeverAnew);
    expect_as_built_from(moved, built, splits());
    EXPECT_EQ(built.report().growth, 1);
    EXPECT_EQ(built.report().occluder_count, refitted.report().occluder_count + 1);
  }
}

// For instances: in leaves and boxes, but not counted.
TEST(RefitOfZeroArea, KeepsItWhereTheBuildDid) {
  const Mesh mesh = tests::random_soup(60, 0.4f, 89);
  Mesh moved = shaken(mesh, 0.1f, 90);
  for (std::size_t i = 0; i < 60; i += 4) moved.positions[3 * i] = moved.positions[3 * i + 1];
  moved.positions[3 * 5].x = kNaN;
  const BuildOptions options{.spatial_splits = false, .keep_zero_area = true};
  const OccluderBvh refitted = OccluderBvh(mesh.view(), options).refitted(moved.positions, kNeverAnew);
  const OccluderBvh built(moved.view(), options);
  EXPECT_EQ(refitted.bounds().lower, built.bounds().lower);
  EXPECT_EQ(refitted.bounds().upper, built.bounds().upper);
  EXPECT_EQ(refitted.report().zero_area_count, 15u);
  EXPECT_EQ(refitted.report().non_finite_count, 1u);
  EXPECT_EQ(refitted.report().occluder_count, 44u);
  EXPECT_EQ(LayoutWalk(refitted.layout()).primitives(), LayoutWalk(built.layout()).primitives());
  EXPECT_EQ(masks(refitted), masks(built));
}

TEST(RefitOfNothing, BlocksNothing) {
  const OccluderBvh refitted = OccluderBvh(TriangleMesh{}).refitted({});
  EXPECT_EQ(refitted.report().triangle_count, 0u);
  EXPECT_EQ(refitted.report().growth, 1);
  EXPECT_GT(refitted.bounds().lower.x, refitted.bounds().upper.x);
}

TEST(RefitOfOneTriangle, FollowsIt) {
  const Mesh mesh = tests::random_soup(1, 0.4f, 79), moved = shaken(mesh, 0.5f, 80);
  expect_as_built_from(moved, OccluderBvh(mesh.view()).refitted(moved.positions, kNeverAnew));
}

TEST(RefitThreads, GiveTheSameAtAnyNumber) {
  const tbb::global_control more_threads(tbb::global_control::max_allowed_parallelism, 8);
  const Mesh mesh = tests::random_soup(20'000, 0.02f, 81);  // enough for many tasks
  const Mesh moved = damaged(shaken(mesh, 0.05f, 82), 5);
  const OccluderBvh occluders(mesh.view(), {.spatial_splits = false});
  const auto refit = [&](int thread_count) {
    return tbb::task_arena(thread_count).execute([&] { return occluders.refitted(moved.positions, kNeverAnew); });
  };
  const OccluderBvh single = refit(1);
  EXPECT_FALSE(single.layout().resting.empty());
  for (const int thread_count : {2, 8, 8}) {
    const OccluderBvh other = refit(thread_count);
    tests::expect_equal(single.layout().nodes, other.layout().nodes);
    tests::expect_equal(single.layout().leaves, other.layout().leaves);
    EXPECT_EQ(single.layout().resting, other.layout().resting);
    EXPECT_EQ(single.report().surface_area_cost, other.report().surface_area_cost);
  }
}

TEST(RefitGrowth, SaysWhenToBuildAnew) {
  const Mesh mesh = tests::random_soup(500, 0.05f, 83);
  const OccluderBvh occluders(mesh.view(), {.spatial_splits = false});
  EXPECT_EQ(occluders.report().growth, 1);
  EXPECT_EQ(occluders.refitted(mesh.positions).report().growth, 1);
  // A scene twice as large is as good.
  Mesh larger = mesh;
  for (glm::vec3& p : larger.positions) p *= 2.0f;
  EXPECT_NEAR(occluders.refitted(larger.positions).report().growth, 1, 1e-5);
  // Triangles that change places are not.
  Mesh mixed = mesh;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    mixed.positions[i] = mesh.positions[(i + 600) % mesh.positions.size()];
  }
  const OccluderBvh refitted = occluders.refitted(mixed.positions, kNeverAnew);
  EXPECT_GT(refitted.report().growth, 4);
  const OccluderBvh built = occluders.refitted(mixed.positions);
  EXPECT_EQ(built.report().growth, 1);
  EXPECT_EQ(built.report().surface_area_cost,
            OccluderBvh(mixed.view(), {.spatial_splits = false}).report().surface_area_cost);
  // From the last build on.
  EXPECT_EQ(built.refitted(mixed.positions).report().growth, 1);
  EXPECT_EQ(refitted.refitted(mesh.positions).report().growth, 1);
}

// Then a hierarchy built anew is no better.
TEST(RefitGrowth, IsNotThatOfTheTriangles) {
  Mesh mesh = tests::random_soup(500, 0.05f, 88);
  const OccluderBvh occluders(mesh.view(), {.spatial_splits = false});
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 a = mesh.positions[t.x];
    for (const unsigned corner : {t.y, t.z}) mesh.positions[corner] = a + 5.0f * (mesh.positions[corner] - a);
  }
  const OccluderBvh refitted = occluders.refitted(mesh.positions, kNeverAnew);
  EXPECT_GT(refitted.report().surface_area_cost, 1.5 * occluders.report().surface_area_cost);
  EXPECT_LT(refitted.report().growth, 1.2);
}

TEST(RefitGrowth, IsThatOfBoxes) {
  Mesh mesh;  // two leaves
  for (int i = 0; i < 5; ++i) {
    const auto first = static_cast<unsigned>(mesh.positions.size());
    const auto x = static_cast<float>(i < 4 ? 0 : 9);
    mesh.positions.insert(mesh.positions.end(), {{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 1}});
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  // Bounds of 10 x 1 x 1 hold two boxes of 1 x 1 x 1: 1 + 2 x 3 / 21.
  const OccluderBvh occluders(mesh.view(), {.spatial_splits = false});
  EXPECT_NEAR(occluders.report().surface_area_cost, 1 + 6.0 / 21, 1e-5);
  // One of the four at the other end: 1 + (21 + 3) / 21.
  for (int corner = 0; corner < 3; ++corner) mesh.positions[static_cast<std::size_t>(corner)].x += 9;
  const OccluderBvh refitted = occluders.refitted(mesh.positions, kNeverAnew);
  EXPECT_NEAR(refitted.report().surface_area_cost, 1 + 24.0 / 21, 1e-5);
  EXPECT_NEAR(refitted.report().growth, 24.0 / 6, 1e-5);
}

std::string message_of(const OccluderBvh& occluders, const std::vector<glm::vec3>& positions,
                       const RefitOptions& options) {
  try {
    (void)occluders.refitted(positions, options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(RefitErrors, NameTheArgument) {
  Mesh mesh = tests::random_soup(10, 0.4f, 84);
  const OccluderBvh occluders(mesh.view());
  EXPECT_EQ(message_of(occluders, mesh.positions, {.max_growth = 0.5}), "max_growth must be at least 1, not 0.5");
  EXPECT_EQ(message_of(occluders, mesh.positions, {.max_growth = NAN}), "max_growth must be at least 1, not nan");
  mesh.positions.pop_back();
  EXPECT_EQ(message_of(occluders, mesh.positions, {}), "there must be 30 positions, as at the build, not 29");
}

TEST(RefitProgress, CountsLeavesAndStops) {
  const Mesh mesh = tests::random_soup(20'000, 0.02f, 85);
  const OccluderBvh occluders(mesh.view(), {.spatial_splits = false});
  const std::size_t leaf_count = occluders.layout().leaves.size();
  std::size_t last = 0, calls = 0;
  occluders.refitted(mesh.positions, {}, [&](std::size_t done, std::size_t total) {
    EXPECT_EQ(total, leaf_count);
    EXPECT_GT(done, last);
    last = done;
    ++calls;
    return true;
  });
  EXPECT_EQ(last, leaf_count);
  EXPECT_GT(calls, 10u);
  EXPECT_THROW(
      occluders.refitted(mesh.positions, {}, [&](std::size_t done, std::size_t total) { return done < total / 2; }),
      Cancelled);
}

TEST(RefitOrigin, IsThatOfTheNewPositions) {
  const Mesh mesh = tests::random_soup(50, 0.4f, 86), moved = shaken(mesh, 0.5f, 87);
  const glm::dvec3 origin(4e6, -5e6, 1e5);
  std::vector<glm::dvec3> far;
  far.reserve(moved.positions.size());
  for (const glm::vec3& p : moved.positions) far.push_back(origin + glm::dvec3(p));
  Mesh seen = moved;
  for (std::size_t i = 0; i < far.size(); ++i) seen.positions[i] = glm::vec3(far[i] - origin);
  const OccluderBvh refitted = OccluderBvh(mesh.view()).refitted({far, origin}, kNeverAnew);
  EXPECT_EQ(refitted.origin(), origin);
  expect_as_built_from(seen, refitted);
}

}  // namespace
}  // namespace lkao
