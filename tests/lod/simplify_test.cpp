#include "lod/simplify.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "lod/meshes.h"
#include "lod/triangle_pairs.h"
#include "scene/builtin.h"
#include "scene/defects.h"
#include "support/sanitized.h"

namespace lkao::lod {
namespace {

SimplifyOptions options(float epsilon, int level_count = 4) {
  return {.levels = {.epsilon = epsilon, .level_count = level_count}};
}

void expect_accounted_for(const SimplifyReport& report) {
  EXPECT_EQ(report.triangle_count, report.zero_area_count + report.non_finite_count + report.duplicate_count +
                                       report.small_part_triangle_count + report.simplified_part_triangle_count);
}

// What every chain promises, measured anew over whole meshes.
void expect_good_chain(const scene::Mesh& mesh, const Simplified& result) {
  expect_accounted_for(result.report);
  scene::Mesh usable = mesh;
  scene::drop_bad_triangles(usable);
  const Surface original(usable);
  ASSERT_EQ(result.report.levels.size(), result.chain.levels.size());
  EXPECT_EQ(result.chain.levels[0].mesh.positions.size(), mesh.positions.size());
  EXPECT_EQ(result.chain.levels[0].mesh.triangles, mesh.triangles);
  for (std::size_t i = 1; i < result.chain.levels.size(); ++i) {
    const Level& level = result.chain.levels[i];
    const LevelReport& report = result.report.levels[i];
    EXPECT_EQ(report.triangle_count, level.mesh.triangles.size());
    EXPECT_LE(report.triangle_count, result.report.levels[i - 1].triangle_count);
    EXPECT_LE(report.from_original.maximum, level.epsilon);
    EXPECT_LE(report.to_original.maximum, level.epsilon);
    const scene::Defects defects = scene::find_defects(level.mesh);
    EXPECT_EQ(defects.zero_area_count + defects.non_finite_count + defects.unused_vertex_count, 0u);
    // Between samples, no more than the bound says.
    const Sampling sampling{.spacing = report.spacing * 0.7,
                            .most_per_triangle = tests::unless_sanitized(2000.0, 20.0)};
    const Surface simplified(level.mesh);
    const Distance to_original = sum(triangle_distances(level.mesh, original, sampling));
    const Distance from_original = sum(triangle_distances(usable, simplified, sampling));
    EXPECT_LE(to_original.maximum, report.to_original.bound);
    EXPECT_LE(from_original.maximum, report.from_original.bound);
  }
}

TEST(Simplify, AFlatGridLosesNearlyAllTrianglesAndNoShape) {
  const scene::Mesh mesh = flat_grid(40);
  const Simplified result = simplify(mesh, options(0.01f, 2));
  expect_good_chain(mesh, result);
  const LevelReport& level = result.report.levels[1];
  EXPECT_LE(level.triangle_count, 8u);  // of 3,200
  EXPECT_EQ(level.from_original.maximum, 0);
  EXPECT_EQ(level.to_original.maximum, 0);
  EXPECT_NEAR(level.area, 1, 1e-6);
}

TEST(Simplify, ABallStaysWithinEpsilon) {
  const scene::Mesh mesh = ball(1, 64);
  const Simplified result = simplify(mesh, options(0.01f, 5));
  expect_good_chain(mesh, result);
  const auto& levels = result.report.levels;
  EXPECT_LT(levels[1].triangle_count, levels[0].triangle_count / 3);
  EXPECT_LT(levels[2].triangle_count, levels[1].triangle_count / 2);
  EXPECT_LT(levels[3].triangle_count, levels[2].triangle_count / 2);
  EXPECT_GT(levels[1].from_original.maximum, 0.001);  // it does use what it is allowed
}

TEST(Simplify, WavesWithABorderStayWithinEpsilon) {
  const scene::Mesh mesh = wavy_grid(40);
  const Simplified result = simplify(mesh, options(0.004f));
  expect_good_chain(mesh, result);
  EXPECT_LT(result.report.levels[1].triangle_count, mesh.triangles.size() / 4);
}

// A flat sheet with a slit from its border to beyond its middle. Half of its width is less than epsilon: no point of a
// triangle that closes it is too far from the sheet.
TEST(Simplify, ASlitStaysOpen) {
  scene::Mesh mesh = flat_grid(20);
  std::erase_if(mesh.triangles, [&](const glm::uvec3& t) {
    const glm::vec3 middle = (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0f;
    return middle.x > 0.45f && middle.x < 0.5f && middle.z < 0.7f;
  });
  const Simplified result = simplify(mesh, options(0.03f, 2));
  expect_good_chain(mesh, result);
  EXPECT_LT(result.report.levels[1].triangle_count, 40u);
  const Surface level(result.chain.levels[1].mesh);
  for (const double z : {0.1, 0.3, 0.5, 0.6}) EXPECT_GT(level.nearest({0.475, 0, z}).distance, 0.01) << z;
}

// Winding tubes: triangles that cut across the windings have all their corners on the tube.
TEST(Simplify, TrianglesDoNotCutAcrossTheAir) {
  const scene::Mesh mesh = scene::make_hairball(tests::unless_sanitized(10'000, 2'000));
  const Simplified result = simplify(mesh, options(0.0167f, 3));
  expect_good_chain(mesh, result);
  EXPECT_LT(result.report.levels[1].triangle_count, mesh.triangles.size());
}

TEST(Simplify, NothingVanishes) {
  // Balls far smaller than every epsilon, a lone triangle, and a small strip.
  scene::Mesh mesh;
  for (int i = 0; i < 5; ++i) {
    scene::add_sphere(mesh, {i, 0, 0}, 0.01, 16, 8);
  }
  scene::add_triangle(mesh, {0, 5, 0}, {0.01, 5, 0}, {0, 5.01, 0});
  const Simplified result = simplify(mesh, options(1));
  expect_good_chain(mesh, result);
  EXPECT_EQ(result.report.small_part_count, 1u);
  for (const Level& level : result.chain.levels) {
    const Surface surface(level.mesh);
    for (int i = 0; i < 5; ++i) EXPECT_LT(surface.nearest({i, 0, 0}).distance, 0.011);
    EXPECT_LT(surface.nearest({0, 5, 0}).distance, 1e-9);
  }
  // They keep a shape: a share of their surface that the size allows for, not epsilon.
  EXPECT_GT(result.report.levels[3].area, 0.6 * result.report.levels[0].area);
  EXPECT_GE(result.report.levels[3].triangle_count, 5u * 8 + 1);
}

TEST(Simplify, AwkwardMeshesComeThrough) {
  // A grid, its back side, a wall on it, a duplicate, a bow tie, a triangle of no area, one that is not finite.
  scene::Mesh mesh = wavy_grid(16);
  const std::vector<glm::uvec3> front = mesh.triangles;
  for (const glm::uvec3& t : front) mesh.triangles.emplace_back(t.x, t.z, t.y);
  const auto first = static_cast<unsigned>(mesh.positions.size());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  mesh.positions.insert(mesh.positions.end(), {{0.5f, 1, 0.5f}, {0, 0, -1}, {-1, 0, 0}, {nan, 0, 0}});
  mesh.triangles.insert(mesh.triangles.end(),
                        {{100, 101, first}, {0, first + 1, first + 2}, front[7], {3, 3, 4}, {1, 2, first + 3}});
  const Simplified result = simplify(mesh, options(0.005f));
  expect_good_chain(mesh, result);
  EXPECT_EQ(result.report.duplicate_count, 1u);
  EXPECT_EQ(result.report.zero_area_count, 1u);
  EXPECT_EQ(result.report.non_finite_count, 1u);
  EXPECT_GT(result.report.crowded_edge_count, 0u);
  EXPECT_GT(result.report.split_vertex_count, 0u);
}

TEST(Simplify, TheSameOnAnyNumberOfThreads) {
  scene::Mesh mesh = wavy_grid(40);
  for (int i = 0; i < tests::unless_sanitized(30, 6); ++i) scene::add_sphere(mesh, {i, 3, 0}, 0.1 + 0.01 * i, 20, 10);
  const Simplified parallel = simplify(mesh, options(0.003f));
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const Simplified serial = simplify(mesh, options(0.003f));
  for (std::size_t i = 0; i < parallel.chain.levels.size(); ++i) {
    EXPECT_EQ(parallel.chain.levels[i].mesh.positions, serial.chain.levels[i].mesh.positions);
    EXPECT_EQ(parallel.chain.levels[i].mesh.triangles, serial.chain.levels[i].mesh.triangles);
    EXPECT_EQ(parallel.report.levels[i].from_original.maximum, serial.report.levels[i].from_original.maximum);
    EXPECT_EQ(parallel.report.levels[i].to_original.rms(), serial.report.levels[i].to_original.rms());
  }
}

// Large enough to be simplified in several regions at a time, over several rounds.
scene::Mesh bumpy_ball(int segment_count) {
  scene::Mesh mesh = ball(1, segment_count);
  for (glm::vec3& p : mesh.positions) p *= 1 + 0.02f * std::sin(9 * p.x) * std::sin(11 * p.y) * std::sin(10 * p.z);
  return mesh;
}

TEST(Simplify, OneLargePartIsTheSameOnAnyNumberOfThreads) {
  const scene::Mesh mesh = bumpy_ball(tests::unless_sanitized(240, 192));
  const auto simplify_on = [&](std::size_t thread_count) {
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, thread_count);
    return simplify(mesh, options(0.02f, 2));
  };
  const Simplified serial = simplify_on(1);
  EXPECT_EQ(serial.report.simplified_part_count, 1u);
  for (const std::size_t thread_count : tests::unless_sanitized<std::vector<std::size_t>>({2, 5}, {5})) {
    const Simplified parallel = simplify_on(thread_count);
    for (std::size_t i = 0; i < parallel.chain.levels.size(); ++i) {
      EXPECT_EQ(parallel.chain.levels[i].mesh.positions, serial.chain.levels[i].mesh.positions) << thread_count;
      EXPECT_EQ(parallel.chain.levels[i].mesh.triangles, serial.chain.levels[i].mesh.triangles) << thread_count;
    }
  }
}

// Every edge has a triangle on both sides, and the levels are still balls.
TEST(Simplify, ALargeClosedMeshStaysClosedAcrossRegions) {
  const scene::Mesh mesh = bumpy_ball(tests::unless_sanitized(240, 192));
  const Simplified result = simplify(mesh, options(0.02f, 3));
  expect_good_chain(mesh, result);
  for (const Level& level : result.chain.levels) {
    const TrianglePairs pairs = pair_triangles(level.mesh.positions, level.mesh.triangles);
    EXPECT_EQ(std::ranges::count(pairs.partner, kNoHalfEdge), 0);
    EXPECT_EQ(pairs.crowded_edge_count, 0u);
    // Euler: V - E + F = 2, with three half-edges a triangle.
    EXPECT_EQ(2 * level.mesh.positions.size(), level.mesh.triangles.size() + 4);
  }
  EXPECT_LT(result.report.levels[1].triangle_count, mesh.triangles.size() / 30);
}

TEST(Simplify, ProgressReachesTheEndAndNeverGoesBack) {
  const scene::Mesh mesh = ball(1, tests::unless_sanitized(96, 48));
  std::size_t last = 0, total = 0, calls = 0;
  simplify(mesh, options(0.01f), [&](std::size_t done, std::size_t all) {
    EXPECT_GT(done, last);
    last = done;
    total = all;
    ++calls;
    return true;
  });
  EXPECT_EQ(last, total);
  EXPECT_EQ(total, mesh.triangles.size());
  EXPECT_GT(calls, 2u);
}

TEST(Simplify, EndsWhereProgressThrowsOrSaysSo) {
  struct Enough {};
  const Progress thrower = [](std::size_t, std::size_t) -> bool { throw Enough(); };
  EXPECT_THROW(simplify(ball(1, 96), options(0.01f), thrower), Enough);
  std::size_t calls = 0;
  const auto stop = [&](std::size_t, std::size_t) { return ++calls < 2; };
  EXPECT_THROW(simplify(ball(1, 96), options(0.01f), stop), Cancelled);
  EXPECT_EQ(calls, 2u);
}

TEST(Simplify, RejectsWhatIsNoMesh) {
  EXPECT_THROW(simplify({}, options(1)), std::invalid_argument);
  const scene::Mesh wild{.positions = {{0, 0, 0}}, .triangles = {{0, 0, 1}}};
  EXPECT_THROW(simplify(wild, options(1)), std::invalid_argument);
  EXPECT_THROW(simplify(ball(1, 8), options(0)), std::invalid_argument);
}

TEST(Simplify, OnlyBadTrianglesLeaveEmptyLevels) {
  const scene::Mesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, .triangles = {{0, 1, 2}}};
  const Simplified result = simplify(mesh, options(1));
  expect_accounted_for(result.report);
  EXPECT_EQ(result.chain.levels[0].mesh.triangles.size(), 1u);
  EXPECT_EQ(result.chain.levels[1].mesh.triangles.size(), 0u);
}

}  // namespace
}  // namespace lkao::lod
