// Wrong arguments of the C interface: a status, and a message that names function, argument and value.
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "c_api/owned.h"
#include "lkao/c.h"
#include "lkao/lkao.h"
#include "support/meshes.h"

namespace lkao {
namespace {

using tests::c_pattern;
using tests::c_rays;
using tests::made;
using tests::OwnedAo;
using tests::OwnedPattern;
using tests::OwnedScene;
using tests::OwnedTable;

void expect_error(lkao_status actual, const std::string& message, lkao_status status = LKAO_ERROR_INVALID_ARGUMENT) {
  EXPECT_STREQ(lkao_status_name(actual), lkao_status_name(status));
  EXPECT_EQ(lkao_last_error(), message);
}

class CErrors : public testing::Test {
 protected:
  OwnedScene scene_ = tests::c_scene(tests::closed_box());
  OwnedPattern pattern_ = c_pattern(70);
  lkao_ray_options options_ = c_rays(1);
  OwnedAo ao_ = tests::c_ao(scene_, pattern_, options_);
  lkao_receiver receiver_ = tests::c_receiver({.position = {0, 0, 0}, .normal = {0, 0, 1}});
  lkao_answer answer_ = LKAO_ANSWER_INIT;
};

TEST_F(CErrors, OfMeshes) {
  const tests::Mesh box = tests::closed_box();
  lkao_bvh* bvh = reinterpret_cast<lkao_bvh*>(scene_.get());
  const auto refuse = [&](const lkao_mesh& mesh, const std::string& message) {
    expect_error(lkao_bvh_create(&mesh, nullptr, &bvh), "lkao_bvh_create: " + message);
    EXPECT_EQ(bvh, nullptr);
  };
  const lkao_mesh good = tests::c_mesh(box);
  lkao_mesh mesh = good;
  mesh.positions = nullptr;
  refuse(mesh, "mesh->positions must not be NULL");
  mesh = good, mesh.indices = nullptr;
  refuse(mesh, "mesh->indices must not be NULL");
  mesh = good, mesh.position_type = LKAO_UINT16;
  refuse(mesh, "mesh->position_type must be LKAO_FLOAT or LKAO_DOUBLE, not 2");
  mesh = good, mesh.index_type = LKAO_FLOAT;
  refuse(mesh, "mesh->index_type must be LKAO_UINT16, LKAO_UINT32 or LKAO_INT32, not 0");
  mesh = good, mesh.origin[1] = 3;
  refuse(mesh, "mesh->origin must be 0 unless its position_type is LKAO_DOUBLE");
  mesh = good, mesh.position_stride = 8;
  refuse(mesh, "stride of positions must be 0 or at least 12 bytes, not 8");
  mesh = good, mesh.triangle_stride = 8;
  refuse(mesh, "stride of triangles must be 0 or at least 12 bytes, not 8");
  mesh = good, mesh.position_count = 7;
  refuse(mesh, "triangle 3 has index 7, but there are 7 positions");
  expect_error(lkao_bvh_create(nullptr, nullptr, &bvh), "lkao_bvh_create: mesh must not be NULL");
  expect_error(lkao_bvh_create(&good, nullptr, nullptr), "lkao_bvh_create: bvh must not be NULL");
  lkao_build_options options = LKAO_BUILD_OPTIONS_INIT;
  options.thread_count = -1;
  expect_error(lkao_bvh_create(&good, &options, &bvh),
               "lkao_bvh_create: options->thread_count must be 0 to 4096, not -1");
}

TEST_F(CErrors, OfPatternsAndTables) {
  lkao_pattern* pattern = nullptr;
  lkao_pattern_options options = LKAO_PATTERN_OPTIONS_INIT;
  options.kind = 5;
  expect_error(lkao_pattern_create(&options, &pattern), "lkao_pattern_create: options->kind must be 0 to 4, not 5");
  options = LKAO_PATTERN_OPTIONS_INIT, options.weighting = -1;
  expect_error(lkao_pattern_create(&options, &pattern),
               "lkao_pattern_create: options->weighting must be 0 to 1, not -1");
  options = LKAO_PATTERN_OPTIONS_INIT, options.ray_count = 1025;
  EXPECT_EQ(lkao_pattern_create(&options, &pattern), LKAO_ERROR_INVALID_ARGUMENT);
  EXPECT_THAT(lkao_last_error(), testing::HasSubstr("1025"));
  lkao_falloff falloff = LKAO_FALLOFF_INIT;
  falloff.kind = LKAO_FALLOFF_CUSTOM;
  options = LKAO_PATTERN_OPTIONS_INIT, options.falloff = &falloff;
  expect_error(lkao_pattern_create(&options, &pattern),
               "lkao_pattern_create: options->falloff->function must not be NULL");
  falloff.kind = 9;
  expect_error(lkao_pattern_create(&options, &pattern),
               "lkao_pattern_create: options->falloff->kind must be 0 to 4, not 9");
  falloff.kind = LKAO_FALLOFF_CUSTOM, falloff.function = [](void*, double x) { return x; };
  expect_error(lkao_pattern_create(&options, &pattern),
               "lkao_pattern_create: falloff custom must not rise, but does at "
               "0.000244140625");
  const float points[] = {0, 0}, lengths[] = {1};
  expect_error(lkao_pattern_create_from_disk(points, 4, lengths, 0, 1, &pattern),
               "lkao_pattern_create_from_disk: point_stride must be 0 or at least 8 bytes, not 4");
  expect_error(lkao_pattern_create_from_disk(points, 0, lengths, 0, -1, &pattern),
               "lkao_pattern_create_from_disk: ray_count must be 1 to 1024, not -1");
  double value = 0;
  falloff = LKAO_FALLOFF_INIT;
  expect_error(lkao_falloff_value(&falloff, 1.5, &value), "lkao_falloff_value: x must be in [0, 1], not 1.500000");

  lkao_table_options table_options = LKAO_TABLE_OPTIONS_INIT;
  table_options.resolution = 32;
  const OwnedTable table = made<OwnedTable>(lkao_table_create, pattern_.get(), &table_options);
  std::uint32_t cell = 0;
  const float long_normal[] = {0, 2, 0}, normal[] = {0, 1, 0};
  expect_error(lkao_table_cell(table.get(), long_normal, 0, &cell),
               "lkao_table_cell: n must be a unit vector, not of length 2.000000");
  expect_error(lkao_table_cell(table.get(), normal, std::nanf(""), &cell),
               "lkao_table_cell: d must be a number, not nan");
  EXPECT_EQ(lkao_table_must(table.get(), 0xffffffffu), nullptr);
  EXPECT_THAT(lkao_last_error(),
              testing::MatchesRegex("lkao_table_must: cell must be less than [0-9]+, not 4294967295"));
  EXPECT_EQ(lkao_table_nearest(table.get(), 0), nullptr);
  EXPECT_STREQ(lkao_last_error(),
               "lkao_table_nearest: table has no nearest masks: it was made with LKAO_MASKS_MUST_MAY");
}

TEST_F(CErrors, OfQueries) {
  lkao_ao* ao = nullptr;
  expect_error(lkao_ao_create(scene_.get(), pattern_.get(), &options_, 2, &ao),
               "lkao_ao_create: kernel must be 0 to 1, not 2");
  lkao_ray_options options = LKAO_RAY_OPTIONS_INIT;
  expect_error(lkao_ao_create(scene_.get(), pattern_.get(), &options, LKAO_SIMD, &ao),
               "lkao_ao_create: radius must be greater than 0 and at most 1e18, or infinity, not 0");
  options = options_, options.sidedness = 2;
  expect_error(lkao_ao_create(scene_.get(), pattern_.get(), &options, LKAO_SIMD, &ao),
               "lkao_ao_create: options->sidedness must be 0 to 1, not 2");
  expect_error(lkao_ao_create_levels(nullptr, 0, pattern_.get(), &options_, LKAO_SIMD, &ao),
               "lkao_ao_create_levels: levels must be at least one, not 0");
  lkao_level level = LKAO_LEVEL_INIT;
  expect_error(lkao_ao_create_levels(&level, 1, pattern_.get(), &options_, LKAO_SIMD, &ao),
               "lkao_ao_create_levels: levels[0]->scene is NULL: it must be a lkao_scene", LKAO_ERROR_INVALID_HANDLE);
  level.scene = scene_.get();
  expect_error(lkao_ao_create_levels(&level, 1, pattern_.get(), &options_, LKAO_SIMD, &ao),
               "lkao_ao_create_levels: levels[0] must have 0 <= r_min < r_max, not 0 and 0");

  std::uint64_t mask[2] = {7, 7};
  expect_error(lkao_ao_blocked(ao_.get(), &receiver_, 0, mask, 1),
               "lkao_ao_blocked: word_count must be at least the pattern's, 2, not 1");
  EXPECT_EQ(mask[0], 7u);
  expect_error(lkao_ao_blocked(ao_.get(), &receiver_, 0, nullptr, 2), "lkao_ao_blocked: mask must not be NULL");
  expect_error(lkao_ao_query(ao_.get(), nullptr, 0, &answer_), "lkao_ao_query: receiver must not be NULL");
  expect_error(lkao_ao_query(ao_.get(), &receiver_, 0, nullptr), "lkao_ao_query: answer must not be NULL");
  float segments[3];
  expect_error(lkao_ao_get_rays(ao_.get(), &receiver_, 0, nullptr, segments, 8),
               "lkao_ao_get_rays: segment_stride must be 0 or at least 12 bytes, not 8");
  lkao_neighbourhood* near = nullptr;
  const lkao_bounds empty{{1, 0, 0}, {0, 0, 0}};
  EXPECT_EQ(lkao_neighbourhood_create(ao_.get(), &empty, &near), LKAO_ERROR_INVALID_ARGUMENT);
  EXPECT_THAT(lkao_last_error(), testing::HasSubstr("positions must be a box"));

  lkao_receivers receivers = LKAO_RECEIVERS_INIT;
  receivers.count = 1;
  lkao_outputs outputs = LKAO_OUTPUTS_INIT;
  const auto batch = [&] { return lkao_ao_query_batch(ao_.get(), &receivers, &outputs, nullptr, nullptr); };
  expect_error(batch(), "lkao_ao_query_batch: receivers->positions must not be NULL");
  receivers.positions = receiver_.position;
  expect_error(batch(), "lkao_ao_query_batch: receivers->normals must not be NULL");
  receivers.normals = receiver_.normal, receivers.normal_stride = 4;
  expect_error(batch(), "lkao_ao_query_batch: receivers->normal_stride must be 0 or at least 12 bytes, not 4");
  receivers.normal_stride = 0, outputs.masks = mask, outputs.mask_stride = 8;
  expect_error(batch(), "lkao_ao_query_batch: outputs->mask_stride must be 0 or at least 16 bytes, not 8");
}

TEST_F(CErrors, OfHandles) {
  lkao_ao* ao = nullptr;
  const auto create = [&](const void* scene) {
    return lkao_ao_create(static_cast<const lkao_scene*>(scene), pattern_.get(), &options_, LKAO_SIMD, &ao);
  };
  expect_error(create(nullptr), "lkao_ao_create: scene is NULL: it must be a lkao_scene", LKAO_ERROR_INVALID_HANDLE);
  expect_error(create(pattern_.get()), "lkao_ao_create: scene is a lkao_pattern: it must be a lkao_scene",
               LKAO_ERROR_INVALID_HANDLE);
  int foreign = 0;
  const auto on_heap = std::make_unique<int>(0);
  for (const void* other : {static_cast<const void*>(&foreign), static_cast<const void*>(on_heap.get())}) {
    expect_error(create(other), "lkao_ao_create: scene was never a handle: it must be a lkao_scene",
                 LKAO_ERROR_INVALID_HANDLE);
  }
  lkao_scene* const stale = tests::c_scene(tests::closed_box()).release();
  EXPECT_EQ(lkao_scene_destroy(stale), LKAO_OK);
  expect_error(create(stale), "lkao_ao_create: scene was destroyed: it must be a lkao_scene",
               LKAO_ERROR_INVALID_HANDLE);
  expect_error(lkao_scene_destroy(stale), "lkao_scene_destroy: scene was destroyed: it must be a lkao_scene",
               LKAO_ERROR_INVALID_HANDLE);
  // Another one in its place.
  const OwnedScene next = tests::c_scene(tests::closed_box());
  EXPECT_NE(next.get(), stale);
  expect_error(create(stale), "lkao_ao_create: scene was destroyed: it must be a lkao_scene",
               LKAO_ERROR_INVALID_HANDLE);
  EXPECT_EQ(lkao_pattern_ray_count(nullptr), 0);
  EXPECT_STREQ(lkao_last_error(), "lkao_pattern_ray_count: pattern is NULL: it must be a lkao_pattern");
  EXPECT_EQ(lkao_pattern_lengths(nullptr), nullptr);
  EXPECT_EQ(lkao_scene_destroy(nullptr), LKAO_OK);
}

TEST_F(CErrors, AreOfTheirThread) {
  EXPECT_EQ(lkao_pattern_create(nullptr, nullptr), LKAO_ERROR_INVALID_ARGUMENT);
  std::string at_first = "?", after_error;
  std::thread([&] {
    at_first = lkao_last_error();
    lkao_ao_destroy(reinterpret_cast<lkao_ao*>(scene_.get()));
    after_error = lkao_last_error();
  }).join();
  EXPECT_EQ(at_first, "");
  EXPECT_EQ(after_error, "lkao_ao_destroy: ao is a lkao_scene: it must be a lkao_ao");
  EXPECT_STREQ(lkao_last_error(), "lkao_pattern_create: pattern must not be NULL");
  // Success leaves it.
  EXPECT_EQ(lkao_ao_query(ao_.get(), &receiver_, 0, &answer_), LKAO_OK);
  EXPECT_STREQ(lkao_last_error(), "lkao_pattern_create: pattern must not be NULL");
}

TEST_F(CErrors, LeaveNoHandleBehind) {
  const std::size_t before = lkao_live_handle_count();
  lkao_ao* ao = nullptr;
  lkao_ray_options options = LKAO_RAY_OPTIONS_INIT;
  EXPECT_NE(lkao_ao_create(scene_.get(), pattern_.get(), &options, LKAO_SIMD, &ao), LKAO_OK);
  EXPECT_EQ(lkao_live_handle_count(), before);
  EXPECT_EQ(lkao_ao_create(scene_.get(), pattern_.get(), &options_, LKAO_SIMD, &ao), LKAO_OK);
  EXPECT_EQ(lkao_live_handle_count(), before + 1);
  EXPECT_EQ(lkao_ao_destroy(ao), LKAO_OK);
  EXPECT_EQ(lkao_live_handle_count(), before);
}

TEST_F(CErrors, OfMoreThanFitsIntoMemory) {
  lkao_ao* ao = nullptr;
  const lkao_level level = LKAO_LEVEL_INIT;
  expect_error(
      lkao_ao_create_levels(&level, std::numeric_limits<std::size_t>::max(), pattern_.get(), &options_, LKAO_SIMD, &ao),
      "lkao_ao_create_levels: more than fits into memory", LKAO_ERROR_OUT_OF_MEMORY);
}

TEST_F(CErrors, OfStructsWithoutTheirSize) {
  receiver_.size = 0;
  expect_error(lkao_ao_query(ao_.get(), &receiver_, 0, &answer_),
               "lkao_ao_query: receiver->size must be at least 56 bytes, not 0: begin with the struct's LKAO_..._INIT");
  receiver_ = LKAO_RECEIVER_INIT;
  answer_.size = std::numeric_limits<std::size_t>::max();
  EXPECT_EQ(lkao_ao_query(ao_.get(), &receiver_, 0, &answer_), LKAO_ERROR_INVALID_ARGUMENT);
}

TEST_F(CErrors, OfLargerStructsOnlyWhereTheyHaveMore) {
  struct {
    lkao_ray_options options;
    std::int64_t more;  // so long that no bytes between or behind are left undefined
  } newer{options_, 0};
  newer.options.size = sizeof(newer);
  lkao_ao* ao = nullptr;
  ASSERT_EQ(lkao_ao_create(scene_.get(), pattern_.get(), &newer.options, LKAO_SIMD, &ao), LKAO_OK) << lkao_last_error();
  EXPECT_EQ(lkao_ao_destroy(ao), LKAO_OK);
  newer.more = 1;
  expect_error(lkao_ao_create(scene_.get(), pattern_.get(), &newer.options, LKAO_SIMD, &ao),
               "lkao_ao_create: options has members set that lkao " + std::string(lkao_version()) +
                   " does not know: byte " + std::to_string(sizeof(lkao_ray_options)) + " is not 0",
               LKAO_ERROR_UNSUPPORTED);
}

}  // namespace
}  // namespace lkao
