// Batches and builds from the caller's own arrays, watched and stopped.
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "c_api/owned.h"
#include "lkao/c.h"
#include "lkao/lkao.h"
#include "support/meshes.h"
#include "support/receivers.h"

namespace lkao {
namespace {

using namespace tests;  // NOLINT(google-build-using-namespace)

// More than are answered at a time, so short that they are soon done.
constexpr std::size_t kManyCount = 70'000;

// Of an engine: everything of a surface point together.
struct Point {
  float position[3], normal[3], geometric_normal[3], occlusion;
  std::uint32_t excluded;
  float bent_normal[3];
  std::uint64_t mask[2];
};

std::vector<Point> points_of(const std::vector<Receiver>& receivers) {
  std::vector<Point> points(receivers.size());
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    std::memcpy(points[i].position, &receivers[i].position, sizeof(points[i].position));
    std::memcpy(points[i].normal, &receivers[i].normal, sizeof(points[i].normal));
    std::memcpy(points[i].geometric_normal, &receivers[i].geometric_normal, sizeof(points[i].geometric_normal));
    points[i].excluded = receivers[i].excluded_primitive;
  }
  return points;
}

lkao_receivers c_receivers(const std::vector<Point>& points) {
  lkao_receivers result = LKAO_RECEIVERS_INIT;
  result.count = points.size();
  result.positions = points[0].position, result.position_stride = sizeof(Point);
  result.normals = points[0].normal, result.normal_stride = sizeof(Point);
  result.geometric_normals = points[0].geometric_normal, result.geometric_normal_stride = sizeof(Point);
  result.excluded_primitives = &points[0].excluded, result.excluded_primitive_stride = sizeof(Point);
  return result;
}

TEST(CBatch, AnswersBetweenOtherDataAsCpp) {
  const Mesh mesh = random_soup(500, 0.1f, 3);
  const OwnedAo ao = c_ao(c_scene(mesh), c_pattern(100), c_rays(0.3f));
  std::vector<Receiver> receivers = with_exclusions(random_receivers(500, 1, 11), 4);
  receivers[7].normal = glm::vec3(0);
  std::vector<Point> points = points_of(receivers);
  lkao_outputs outputs = LKAO_OUTPUTS_INIT;
  outputs.occlusion = &points[0].occlusion, outputs.occlusion_stride = sizeof(Point);
  outputs.bent_normals = points[0].bent_normal, outputs.bent_normal_stride = sizeof(Point);
  outputs.masks = points[0].mask, outputs.mask_stride = sizeof(Point);
  lkao_batch_options options = LKAO_BATCH_OPTIONS_INIT;
  options.first_index = 1000;
  const lkao_receivers all = c_receivers(points);
  lkao_query_report report = LKAO_QUERY_REPORT_INIT;
  ASSERT_EQ(lkao_ao_query_batch(ao.get(), &all, &outputs, &options, &report), LKAO_OK) << lkao_last_error();

  const AmbientOcclusion expected(OccluderBvh(mesh.view()), SamplePattern::standard(100), {.radius = 0.3f});
  std::vector<float> occlusion(500);
  const QueryReport cpp_report = expected.query(receivers, {.occlusion = occlusion}, 1000);
  EXPECT_EQ(report.receiver_count, 500u);
  EXPECT_EQ(report.invalid_receiver_count, 1u);
  EXPECT_EQ(report.ray_count, cpp_report.ray_count);
  EXPECT_EQ(report.blocked_ray_count, cpp_report.blocked_ray_count);
  EXPECT_TRUE(std::isnan(points[7].occlusion));
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const ReceiverOcclusion right = expected.query(receivers[i], 1000 + i);
    ASSERT_EQ(std::memcmp(&points[i].occlusion, &right.occlusion, sizeof(float)), 0) << i;
    ASSERT_EQ(std::memcmp(points[i].bent_normal, &right.bent_normal, sizeof(right.bent_normal)), 0);
    ASSERT_EQ(std::memcmp(points[i].mask, right.mask.words, sizeof(points[i].mask)), 0);
    ASSERT_EQ(std::memcmp(points[i].normal, &receivers[i].normal, sizeof(glm::vec3)), 0);
  }
}

TEST(CBatch, OfManyPartsIsOneBatch) {
  const Mesh mesh = random_soup(20, 0.3f, 3);
  const OwnedAo ao = c_ao(c_scene(mesh), c_pattern(1), c_rays(0.2f));
  const std::vector<Receiver> receivers = random_receivers(static_cast<int>(kManyCount), 1, 11);
  const std::vector<Point> points = points_of(receivers);
  const lkao_receivers all = c_receivers(points);
  std::vector<float> occlusion(kManyCount);
  lkao_outputs outputs = LKAO_OUTPUTS_INIT;
  outputs.occlusion = occlusion.data();
  const AmbientOcclusion cpp(OccluderBvh(mesh.view()), SamplePattern::standard(1), {.radius = 0.2f});
  std::vector<float> expected(kManyCount);
  EXPECT_GT(cpp.query(receivers, {.occlusion = expected}).blocked_ray_count, 500u);
  for (const int thread_count : {0, 1, 3}) {
    struct Seen {
      std::size_t calls = 0, last = 0;
      bool is_right = true;
    } seen;
    lkao_batch_options options = LKAO_BATCH_OPTIONS_INIT;
    options.thread_count = thread_count;
    options.progress = [](void* user, std::size_t done, std::size_t total) {
      auto& so_far = *static_cast<Seen*>(user);
      so_far.is_right &= total == kManyCount && done >= so_far.last;
      so_far.last = done;
      ++so_far.calls;
      return 1;
    };
    options.progress_user = &seen;
    occlusion.assign(kManyCount, -1);
    ASSERT_EQ(lkao_ao_query_batch(ao.get(), &all, &outputs, &options, nullptr), LKAO_OK) << lkao_last_error();
    EXPECT_EQ(occlusion, expected);
    EXPECT_TRUE(seen.is_right);
    EXPECT_GT(seen.calls, 2u);
    EXPECT_EQ(seen.last, kManyCount);
  }
}

TEST(CBatch, OfNothingIsAnswered) {
  const OwnedAo ao = c_ao(c_scene(closed_box()), c_pattern(64), c_rays(1));
  const lkao_receivers none = LKAO_RECEIVERS_INIT;
  const lkao_outputs outputs = LKAO_OUTPUTS_INIT;
  EXPECT_EQ(lkao_ao_query_batch(ao.get(), &none, &outputs, nullptr, nullptr), LKAO_OK) << lkao_last_error();
}

int stop(void* user, std::size_t, std::size_t) {
  ++*static_cast<int*>(user);
  return 0;
}

TEST(CProgress, StopsBatchesAndBuilds) {
  const Mesh mesh = random_soup(20'000, 0.1f, 3);
  const OwnedBvh bvh = c_bvh(mesh);
  const OwnedAo ao = c_ao(c_scene(mesh), c_pattern(16), c_rays(0.1f));
  const std::vector<Point> points = points_of(random_receivers(5000, 1, 11));
  const lkao_receivers all = c_receivers(points);
  const lkao_outputs outputs = LKAO_OUTPUTS_INIT;
  int call_count = 0;
  lkao_batch_options batch = LKAO_BATCH_OPTIONS_INIT;
  batch.progress = stop, batch.progress_user = &call_count;
  lkao_query_report report = LKAO_QUERY_REPORT_INIT;
  report.ray_count = 77;
  EXPECT_EQ(lkao_ao_query_batch(ao.get(), &all, &outputs, &batch, &report), LKAO_ERROR_CANCELLED);
  EXPECT_STREQ(lkao_last_error(), "lkao_ao_query_batch: cancelled");
  EXPECT_EQ(report.ray_count, 77u);
  EXPECT_GE(call_count, 1);

  call_count = 0;
  lkao_build_options build = LKAO_BUILD_OPTIONS_INIT;
  build.progress = stop, build.progress_user = &call_count;
  const lkao_mesh view = c_mesh(mesh);
  lkao_bvh* stopped = bvh.get();
  EXPECT_EQ(lkao_bvh_create(&view, &build, &stopped), LKAO_ERROR_CANCELLED);
  EXPECT_EQ(stopped, nullptr);
  EXPECT_GE(call_count, 1);
}

TEST(CProgress, WhatACallbackThrowsIsAStatus) {
  const Mesh mesh = random_soup(20'000, 0.1f, 3);
  const lkao_mesh view = c_mesh(mesh);
  lkao_build_options build = LKAO_BUILD_OPTIONS_INIT;
  lkao_bvh* bvh = nullptr;
  build.progress = [](void*, std::size_t, std::size_t) -> int { throw std::runtime_error("two\nlines"); };
  EXPECT_EQ(lkao_bvh_create(&view, &build, &bvh), LKAO_ERROR_INTERNAL);
  EXPECT_STREQ(lkao_last_error(), "lkao_bvh_create: two lines");
  build.progress = [](void*, std::size_t, std::size_t) -> int { throw 7; };
  EXPECT_EQ(lkao_bvh_create(&view, &build, &bvh), LKAO_ERROR_INTERNAL);
  EXPECT_STREQ(lkao_last_error(), "lkao_bvh_create: an exception of an unknown type");
}

TEST(CBvh, TakesMeshesOfAnyLayout) {
  const Mesh mesh = random_soup(200, 0.3f, 3);
  // Doubles far from zero, padded to four; indices of 16 bits, between others.
  const glm::dvec3 far(1e7, -2e7, 3e6);
  std::vector<glm::dvec4> positions;
  for (const glm::vec3& p : mesh.positions) positions.emplace_back(far + glm::dvec3(p), 0);
  std::vector<std::array<std::uint16_t, 4>> triangles;
  for (const glm::uvec3& t : mesh.triangles) {
    triangles.push_back({static_cast<std::uint16_t>(t.x), static_cast<std::uint16_t>(t.y),
                         static_cast<std::uint16_t>(t.z), std::uint16_t{60'000}});
  }
  lkao_mesh view = LKAO_MESH_INIT;
  view.positions = positions.data(), view.position_count = positions.size();
  view.position_stride = sizeof(positions[0]), view.position_type = LKAO_DOUBLE;
  view.indices = triangles.data(), view.triangle_count = triangles.size();
  view.triangle_stride = sizeof(triangles[0]), view.index_type = LKAO_UINT16;
  ASSERT_EQ(lkao_choose_origin(&view, view.origin), LKAO_OK);
  EXPECT_NE(view.origin[0], 0);
  lkao_build_options options = LKAO_BUILD_OPTIONS_INIT;
  options.spatial_splits = 0, options.thread_count = 1;
  const OwnedBvh bvh = made<OwnedBvh>(lkao_bvh_create, &view, &options);

  const PositionView cpp_positions(&positions[0].x, positions.size(),
                                   glm::dvec3(view.origin[0], view.origin[1], view.origin[2]), sizeof(positions[0]));
  const OccluderBvh expected({cpp_positions, mesh.triangles}, {.spatial_splits = false});
  double origin[3] = {};
  ASSERT_EQ(lkao_bvh_get_origin(bvh.get(), origin), LKAO_OK);
  EXPECT_EQ(glm::dvec3(origin[0], origin[1], origin[2]), expected.origin());
  lkao_bounds bounds;
  ASSERT_EQ(lkao_bvh_get_bounds(bvh.get(), &bounds), LKAO_OK);
  EXPECT_EQ(std::memcmp(&bounds, &expected.bounds(), sizeof(bounds)), 0);
  lkao_build_report report = LKAO_BUILD_REPORT_INIT;
  ASSERT_EQ(lkao_bvh_get_report(bvh.get(), &report), LKAO_OK);
  EXPECT_EQ(report.triangle_count, 200u);
  EXPECT_EQ(report.occluder_count, expected.report().occluder_count);
  EXPECT_EQ(report.reference_count, expected.report().reference_count);
  EXPECT_EQ(report.node_count, expected.report().node_count);
  EXPECT_EQ(report.memory_bytes, expected.report().memory_bytes);
  EXPECT_GT(report.seconds, 0);
}

TEST(CBvh, RefitsAsThatOfCpp) {
  Mesh mesh = random_soup(300, 0.2f, 3);
  for (const lkao_mesh_storage storage : {LKAO_STORAGE_COPY, LKAO_STORAGE_REFER}) {
    const Mesh at_first = mesh;
    const lkao_mesh view = c_mesh(at_first);
    lkao_build_options options = LKAO_BUILD_OPTIONS_INIT;
    options.mesh_storage = storage;
    const OwnedBvh bvh = made<OwnedBvh>(lkao_bvh_create, &view, &options);
    for (glm::vec3& p : mesh.positions) p.x = 0.5f * p.x + 0.2f * p.y;
    const OccluderBvh built(at_first.view(),
                            {.mesh_storage = storage == LKAO_STORAGE_COPY ? MeshStorage::copy : MeshStorage::refer});
    lkao_build_report report = LKAO_BUILD_REPORT_INIT;
    ASSERT_EQ(lkao_bvh_get_report(bvh.get(), &report), LKAO_OK);
    EXPECT_EQ(report.memory_bytes, built.report().memory_bytes);
    // Within what may grow, and built anew.
    for (const double max_growth : {1000.0, 1.0}) {
      const lkao_mesh moved = c_mesh(mesh);
      lkao_refit_options refit = LKAO_REFIT_OPTIONS_INIT;
      refit.max_growth = max_growth, refit.thread_count = 1;
      const OwnedBvh refitted = made<OwnedBvh>(lkao_bvh_create_refitted, bvh.get(), &moved, &refit);
      const BuildReport expected = built.refitted(mesh.positions, {.max_growth = max_growth}).report();
      ASSERT_EQ(lkao_bvh_get_report(refitted.get(), &report), LKAO_OK);
      EXPECT_EQ(report.surface_area_cost, expected.surface_area_cost);
      EXPECT_EQ(report.growth, expected.growth);
    }
  }
  lkao_refit_options wrong = LKAO_REFIT_OPTIONS_INIT;
  wrong.max_growth = 0.5;
  const OwnedBvh bvh = c_bvh(mesh);
  const lkao_mesh view = c_mesh(mesh);
  lkao_bvh* refitted = nullptr;
  EXPECT_EQ(lkao_bvh_create_refitted(bvh.get(), &view, &wrong, &refitted), LKAO_ERROR_INVALID_ARGUMENT);
  EXPECT_THAT(lkao_last_error(), testing::HasSubstr("max_growth"));
}

TEST(CBvh, CountsWhatItDrops) {
  Mesh mesh = closed_box();
  mesh.positions.emplace_back(std::nanf(""), 0, 0);
  mesh.triangles.emplace_back(0, 1, 8);
  mesh.triangles.emplace_back(0, 1, 1);
  lkao_build_report report = LKAO_BUILD_REPORT_INIT;
  ASSERT_EQ(lkao_bvh_get_report(c_bvh(mesh).get(), &report), LKAO_OK);
  EXPECT_EQ(report.occluder_count, 12u);
  EXPECT_EQ(report.non_finite_count, 1u);
  EXPECT_EQ(report.zero_area_count, 1u);
}

}  // namespace
}  // namespace lkao
