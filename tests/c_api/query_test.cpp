// Queries through C give the bits of those through C++.
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
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

constexpr int kReceiverCount = 60;

std::vector<Receiver> receivers() { return with_exclusions(random_receivers(kReceiverCount, 1, 11), 4); }

void expect_same(const lkao_answer& actual, const ReceiverOcclusion& expected) {
  EXPECT_EQ(std::memcmp(actual.mask, expected.mask.words, sizeof(actual.mask)), 0);
  EXPECT_EQ(actual.occlusion, expected.occlusion);
  EXPECT_EQ(std::memcmp(actual.bent_normal, &expected.bent_normal, sizeof(actual.bent_normal)), 0);
}

// One receiver after the other, all that there is to ask.
void expect_same_answers(const lkao_ao* actual, const AmbientOcclusion& expected) {
  const lkao_bounds box{{-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}};
  const OwnedNeighbourhood near = made<OwnedNeighbourhood>(lkao_neighbourhood_create, actual, &box);
  const std::vector<Receiver> all = receivers();
  const auto word_count = static_cast<std::size_t>(expected.pattern().word_count());
  int blocked_count = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const lkao_receiver receiver = c_receiver(all[i]);
    const ReceiverOcclusion right = expected.query(all[i], i);
    blocked_count += right.mask.count();
    lkao_answer answer = LKAO_ANSWER_INIT;
    ASSERT_EQ(lkao_ao_query(actual, &receiver, i, &answer), LKAO_OK) << lkao_last_error();
    expect_same(answer, right);
    ASSERT_EQ(lkao_neighbourhood_query(near.get(), &receiver, i, &answer), LKAO_OK);
    expect_same(answer, right);
    std::vector<std::uint64_t> mask(word_count + 1, 7);
    ASSERT_EQ(lkao_ao_blocked(actual, &receiver, i, mask.data(), mask.size()), LKAO_OK);
    EXPECT_TRUE(std::equal(mask.begin(), mask.end(), right.mask.words));
    mask.assign(word_count, 7);
    ASSERT_EQ(lkao_neighbourhood_blocked(near.get(), &receiver, i, mask.data(), mask.size()), LKAO_OK);
    EXPECT_TRUE(std::equal(mask.begin(), mask.end(), right.mask.words));
  }
  EXPECT_GT(blocked_count, kReceiverCount);
}

TEST(CQuery, KernelsAnswerAsThoseOfCpp) {
  const Mesh mesh = random_soup(1000, 0.1f, 3);
  const OwnedScene scene = c_scene(mesh);
  const OwnedPattern pattern = c_pattern(100);
  lkao_ray_options options = c_rays(0.4f);
  options.sidedness = LKAO_ONE_SIDED, options.jitter_rotation = 0.5f, options.jitter_tilt = 0.02f;
  options.seed = 9, options.surface_offset = 3, options.min_distance = 0.05f;
  const RayOptions cpp_options{.radius = 0.4f,
                               .sidedness = Sidedness::one_sided,
                               .jitter = {.rotation = 0.5f, .tilt = 0.02f},
                               .seed = 9,
                               .surface_offset = 3,
                               .min_distance = 0.05f};
  const OccluderBvh occluders(mesh.view());
  for (const auto& [number, kernel] : {std::pair{LKAO_SIMD, Kernel::simd}, std::pair{LKAO_SCALAR, Kernel::scalar}}) {
    const OwnedAo ao = made<OwnedAo>(lkao_ao_create, scene.get(), pattern.get(), &options, number);
    expect_same_answers(ao.get(), AmbientOcclusion(occluders, SamplePattern::standard(100), cpp_options, kernel));
  }
}

TEST(CQuery, ByTableAnswersAsThatOfCpp) {
  const Mesh mesh = random_soup(300, 0.1f, 3);
  const OwnedScene scene = c_scene(mesh);
  lkao_table_options table_options = LKAO_TABLE_OPTIONS_INIT;
  table_options.resolution = 32, table_options.masks = LKAO_MASKS_NEAREST;
  const OwnedTable table = made<OwnedTable>(lkao_table_create, c_pattern(64).get(), &table_options);
  const lkao_ray_options options = c_rays(0.4f);
  const PlaneMaskTable cpp_table(SamplePattern::standard(64), {.resolution = 32, .masks = PlaneMasks::nearest});
  for (const auto& [number, node_masks] : {std::pair{LKAO_NODES_BOUNDING_SPHERE, NodeMasks::bounding_sphere},
                                           std::pair{LKAO_NODES_BOX_OUTLINE, NodeMasks::box_outline}}) {
    const OwnedAo ao = made<OwnedAo>(lkao_ao_create_by_table, scene.get(), table.get(), &options, number);
    expect_same_answers(ao.get(), AmbientOcclusion(OccluderBvh(mesh.view()), cpp_table, {.radius = 0.4f}, node_masks));
    lkao_table_options back = LKAO_TABLE_OPTIONS_INIT;
    EXPECT_EQ(lkao_table_get_options(made<OwnedTable>(lkao_table_create_of_ao, ao.get()).get(), &back), LKAO_OK);
    EXPECT_EQ(back.resolution, 32);
  }
}

TEST(CQuery, LevelsAnswerAsThoseOfCpp) {
  const Mesh fine = random_soup(1000, 0.1f, 3), coarse = random_soup(50, 0.3f, 4);
  const OwnedScene fine_scene = c_scene(fine), coarse_scene = c_scene(coarse);
  std::array<lkao_level, 2> levels{{LKAO_LEVEL_INIT, LKAO_LEVEL_INIT}};
  levels[0].scene = fine_scene.get(), levels[0].r_max = 0.2f;
  levels[1].scene = coarse_scene.get(), levels[1].r_min = 0.2f,
  levels[1].r_max = std::numeric_limits<float>::infinity();
  const OwnedPattern pattern = c_pattern(64);
  const lkao_ray_options options = c_rays(1);
  const OwnedAo ao =
      made<OwnedAo>(lkao_ao_create_levels, levels.data(), levels.size(), pattern.get(), &options, LKAO_SIMD);
  const OccluderBvh fine_occluders(fine.view());
  expect_same_answers(ao.get(), AmbientOcclusion({{fine_occluders, 0, 0.2f}, {OccluderBvh(coarse.view()), 0.2f}},
                                                 SamplePattern::standard(64), {.radius = 1}));
  lkao_bounds bounds;
  EXPECT_EQ(lkao_scene_get_bounds(made<OwnedScene>(lkao_scene_create_of_ao, ao.get()).get(), &bounds), LKAO_OK);
  EXPECT_EQ(std::memcmp(&bounds, &fine_occluders.bounds(), sizeof(bounds)), 0);
}

TEST(CQuery, RaysAreThoseOfCpp) {
  const Mesh mesh = random_soup(100, 0.1f, 3);
  const lkao_ray_options options = c_rays(0.4f);
  const OwnedAo ao = c_ao(c_scene(mesh), c_pattern(70), options);
  const AmbientOcclusion expected(OccluderBvh(mesh.view()), SamplePattern::standard(70), {.radius = 0.4f});
  for (const Receiver& from : receivers()) {
    const lkao_receiver receiver = c_receiver(from);
    lkao_rays rays = LKAO_RAYS_INIT;
    std::array<float, 70 * 4 + 1> segments;
    segments.fill(-7);
    ASSERT_EQ(lkao_ao_get_rays(ao.get(), &receiver, 3, &rays, segments.data(), 16), LKAO_OK);
    const ReceiverRays right = expected.rays(from, 3);
    EXPECT_EQ(std::memcmp(rays.origin, &right.origin, sizeof(rays.origin)), 0);
    EXPECT_EQ(std::memcmp(rays.frame, &right.frame, sizeof(rays.frame)), 0);
    EXPECT_EQ(std::memcmp(rays.up, &right.up, sizeof(rays.up)), 0);
    EXPECT_EQ(std::memcmp(rays.cast, right.cast.words, sizeof(rays.cast)), 0);
    EXPECT_EQ(rays.radius, right.radius);
    EXPECT_EQ(rays.ray_count, 70);
    for (int i = 0; i < 70; ++i) {
      const float* const segment = &segments[static_cast<std::size_t>(4 * i)];
      ASSERT_EQ(glm::vec3(segment[0], segment[1], segment[2]), right.ray(i));
      ASSERT_EQ(segment[3], -7);
    }
  }
}

TEST(CQuery, SaysWhatItIsMadeOf) {
  const OwnedScene scene = c_scene(closed_box());
  lkao_ray_options options = c_rays(2);
  options.sidedness = LKAO_ONE_SIDED, options.jitter_tilt = 0.1f, options.seed = 5, options.min_distance = 0.5f;
  const OwnedAo ao = c_ao(scene, c_pattern(70), options);
  lkao_ray_options back = LKAO_RAY_OPTIONS_INIT;
  ASSERT_EQ(lkao_ao_get_options(ao.get(), &back), LKAO_OK);
  EXPECT_EQ(std::memcmp(&back, &options, sizeof(back)), 0);
  EXPECT_EQ(lkao_pattern_ray_count(made<OwnedPattern>(lkao_pattern_create_of_ao, ao.get()).get()), 70);
  lkao_scene_report report = LKAO_SCENE_REPORT_INIT;
  EXPECT_EQ(lkao_scene_get_report(made<OwnedScene>(lkao_scene_create_of_ao, ao.get()).get(), &report), LKAO_OK);
  EXPECT_EQ(report.occluder_count, 12u);
  lkao_table* table = nullptr;
  EXPECT_EQ(lkao_table_create_of_ao(ao.get(), &table), LKAO_ERROR_INVALID_ARGUMENT);
  EXPECT_STREQ(lkao_last_error(),
               "lkao_table_create_of_ao: ao has no table: it was not made by lkao_ao_create_by_table");
}

TEST(CQuery, KeepsWhatItWasMadeOf) {
  OwnedAo ao;
  {
    const Mesh mesh = closed_box();
    ao = c_ao(c_scene(mesh), c_pattern(64), c_rays(5));
  }
  const lkao_bounds box{{0, 0, 0}, {0, 0, 0}};
  const OwnedNeighbourhood near = made<OwnedNeighbourhood>(lkao_neighbourhood_create, ao.get(), &box);
  const lkao_receiver inside = c_receiver({.position = {0, 0, 0}, .normal = {0, 0, 1}});
  ao.reset();
  lkao_answer answer = LKAO_ANSWER_INIT;
  ASSERT_EQ(lkao_neighbourhood_query(near.get(), &inside, 0, &answer), LKAO_OK) << lkao_last_error();
  EXPECT_EQ(answer.occlusion, 1);
}

}  // namespace
}  // namespace lkao
