// Scenes through C are those of C++, and may change.
#include <array>
#include <cstring>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/gtc/type_ptr.hpp>

#include "c_api/owned.h"
#include "lkao/c.h"
#include "lkao/lkao.h"
#include "support/meshes.h"
#include "support/receivers.h"

namespace lkao {
namespace {

using namespace tests;  // NOLINT(google-build-using-namespace)

// Turned by a quarter, and moved.
const glm::mat4x3 kTurned(glm::vec3(0, 1, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 0, 1), glm::vec3(0.3f, 0.1f, 0));
const glm::mat4x3 kLarger(glm::vec3(1.5f, 0, 0), glm::vec3(0, 1.5f, 0), glm::vec3(0, 0, 1.5f), glm::vec3(0));

void set_transform(float to_world[12], const glm::mat4x3& from) {
  std::memcpy(to_world, glm::value_ptr(from), sizeof(from));
}

class CScene : public testing::Test {
 protected:
  CScene() {
    instances_[0].groups = 1;
    instances_[1].mesh = 1, instances_[1].groups = 2;
    set_transform(instances_[1].to_world, kTurned);
    instances_[2].mesh = 1;
    set_transform(instances_[2].to_world, kLarger);
  }

  OwnedScene make() const {
    const std::array<const lkao_bvh*, 2> meshes{first_bvh_.get(), second_bvh_.get()};
    return made<OwnedScene>(lkao_scene_create_of_instances, meshes.data(), meshes.size(), instances_.data(),
                            instances_.size(), 1);
  }
  OccluderScene make_cpp() const {
    return {{OccluderBvh(first_.view()), OccluderBvh(second_.view())},
            std::vector<OccluderInstance>{{0, glm::mat4x3(1), 1}, {1, kTurned, 2}, {1, kLarger}}};
  }

  // Receivers that see some groups, and an instance without one of its triangles.
  void expect_same(const lkao_scene* actual, const OccluderScene& expected) const {
    const lkao_ray_options options = c_rays(0.5f);
    const OwnedPattern pattern = c_pattern(64);
    const OwnedAo ao = made<OwnedAo>(lkao_ao_create, actual, pattern.get(), &options, LKAO_SIMD);
    const AmbientOcclusion cpp(expected, SamplePattern::standard(64), {.radius = 0.5f});
    std::vector<Receiver> receivers = random_receivers(60, 1, 11);
    for (std::uint32_t i = 0; i < receivers.size(); ++i) {
      receivers[i].excluded_primitive = i, receivers[i].excluded_instance = i % 3;
      receivers[i].occluder_groups = i % 4 == 0 ? kAllGroups : i % 4;
    }
    lkao_receivers all = LKAO_RECEIVERS_INIT;
    all.count = receivers.size();
    all.positions = &receivers[0].position.x, all.position_stride = sizeof(Receiver);
    all.normals = &receivers[0].normal.x, all.normal_stride = sizeof(Receiver);
    all.geometric_normals = &receivers[0].geometric_normal.x, all.geometric_normal_stride = sizeof(Receiver);
    all.excluded_primitives = &receivers[0].excluded_primitive, all.excluded_primitive_stride = sizeof(Receiver);
    all.excluded_instances = &receivers[0].excluded_instance, all.excluded_instance_stride = sizeof(Receiver);
    all.occluder_groups = &receivers[0].occluder_groups, all.occluder_group_stride = sizeof(Receiver);
    std::vector<std::uint64_t> masks(receivers.size()), right(receivers.size());
    lkao_outputs outputs = LKAO_OUTPUTS_INIT;
    outputs.masks = masks.data();
    lkao_query_report report = LKAO_QUERY_REPORT_INIT;
    ASSERT_EQ(lkao_ao_query_batch(ao.get(), &all, &outputs, nullptr, &report), LKAO_OK) << lkao_last_error();
    cpp.query(receivers, {.mask_words = right});
    EXPECT_EQ(masks, right);
    EXPECT_GT(report.blocked_ray_count, 50u);
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      const lkao_receiver receiver = c_receiver(receivers[i]);
      std::uint64_t mask = 0;
      ASSERT_EQ(lkao_ao_blocked(ao.get(), &receiver, i, &mask, 1), LKAO_OK);
      ASSERT_EQ(mask, right[i]);
    }
  }

  Mesh first_ = random_soup(300, 0.1f, 3), second_ = random_soup(200, 0.1f, 4);
  OwnedBvh first_bvh_ = c_bvh(first_), second_bvh_ = c_bvh(second_);
  std::array<lkao_instance, 3> instances_{{LKAO_INSTANCE_INIT, LKAO_INSTANCE_INIT, LKAO_INSTANCE_INIT}};
};

TEST_F(CScene, OfInstancesIsThatOfCpp) {
  const OwnedScene scene = make();
  const OccluderScene expected = make_cpp();
  expect_same(scene.get(), expected);
  lkao_scene_report report = LKAO_SCENE_REPORT_INIT;
  ASSERT_EQ(lkao_scene_get_report(scene.get(), &report), LKAO_OK);
  EXPECT_EQ(report.mesh_count, 2u);
  EXPECT_EQ(report.instance_count, 3u);
  EXPECT_EQ(report.occluder_count, 700u);
  EXPECT_EQ(report.memory_bytes, expected.memory_bytes());
  lkao_bounds bounds;
  ASSERT_EQ(lkao_scene_get_bounds(scene.get(), &bounds), LKAO_OK);
  EXPECT_EQ(std::memcmp(&bounds, &expected.bounds(), sizeof(bounds)), 0);
  lkao_instance second = LKAO_INSTANCE_INIT;
  ASSERT_EQ(lkao_scene_get_instance(scene.get(), 1, &second), LKAO_OK);
  EXPECT_EQ(std::memcmp(&second, &instances_[1], sizeof(second)), 0);
  lkao_build_report mesh_report = LKAO_BUILD_REPORT_INIT;
  const OwnedBvh mesh = made<OwnedBvh>(lkao_bvh_create_of_scene, scene.get(), 1u);
  ASSERT_EQ(lkao_bvh_get_report(mesh.get(), &mesh_report), LKAO_OK);
  EXPECT_EQ(mesh_report.triangle_count, 200u);
}

TEST_F(CScene, OfMeshInstancesIsThatOfCpp) {
  const lkao_mesh first = c_mesh(first_), second = c_mesh(second_);
  std::array<lkao_mesh_instance, 3> instances{
      {LKAO_MESH_INSTANCE_INIT, LKAO_MESH_INSTANCE_INIT, LKAO_MESH_INSTANCE_INIT}};
  instances[0].mesh = &first, instances[1].mesh = instances[2].mesh = &second;
  set_transform(instances[1].to_world, kTurned);
  set_transform(instances[2].to_world, kLarger);
  lkao_build_options options = LKAO_BUILD_OPTIONS_INIT;
  options.keep_zero_area = 1;
  const OwnedScene scene =
      made<OwnedScene>(lkao_scene_create_of_mesh_instances, instances.data(), instances.size(), &options);
  expect_same(scene.get(), OccluderScene(std::vector<MeshInstance>{{first_.positions, first_.triangles},
                                                                   {second_.positions, second_.triangles, kTurned},
                                                                   {second_.positions, second_.triangles, kLarger}},
                                         {.keep_zero_area = true}));
  lkao_scene_report report = LKAO_SCENE_REPORT_INIT;
  ASSERT_EQ(lkao_scene_get_report(scene.get(), &report), LKAO_OK);
  EXPECT_EQ(report.mesh_count, 2u);
}

TEST_F(CScene, ChangesAsThatOfCpp) {
  const OwnedScene scene = make();
  OccluderScene expected = make_cpp();
  // Transforms of 16 floats each, of which the last four are not looked at.
  const std::array<std::uint32_t, 2> moved{2, 0};
  std::array<std::array<float, 16>, 2> places{};
  set_transform(places[0].data(), kTurned);
  set_transform(places[1].data(), kLarger);
  ASSERT_EQ(lkao_scene_move(scene.get(), moved.data(), places[0].data(), sizeof(places[0]), 2, 0), LKAO_OK)
      << lkao_last_error();
  expected.move(std::vector<InstanceMove>{{2, kTurned}, {0, kLarger}});
  expect_same(scene.get(), expected);
  ASSERT_EQ(lkao_scene_set_groups(scene.get(), 0, 4), LKAO_OK);
  expected.set_groups(0, 4);
  expect_same(scene.get(), expected);
  ASSERT_EQ(lkao_scene_set_mesh(scene.get(), 1, first_bvh_.get()), LKAO_OK);
  expected.set_mesh(1, OccluderBvh(first_.view()));
  expect_same(scene.get(), expected);
}

TEST_F(CScene, WhatWasMadeOfItStaysAsItWas) {
  const OwnedScene scene = make();
  const OwnedAo ao = c_ao(scene, c_pattern(64), c_rays(0.5f));
  for (std::uint32_t i = 0; i < 3; ++i) ASSERT_EQ(lkao_scene_set_groups(scene.get(), i, 0), LKAO_OK);
  const OwnedScene before = made<OwnedScene>(lkao_scene_create_of_ao, ao.get());
  expect_same(before.get(), make_cpp());
}

TEST_F(CScene, RefusesWhatIsWrong) {
  lkao_scene* scene = nullptr;
  const std::array<const lkao_bvh*, 2> meshes{first_bvh_.get(), nullptr};
  EXPECT_EQ(lkao_scene_create_of_instances(meshes.data(), 2, instances_.data(), 3, 0, &scene),
            LKAO_ERROR_INVALID_HANDLE);
  EXPECT_STREQ(lkao_last_error(), "lkao_scene_create_of_instances: meshes[1] is NULL: it must be a lkao_bvh");
  EXPECT_EQ(lkao_scene_create_of_instances(meshes.data(), 1, nullptr, 3, 0, &scene), LKAO_ERROR_INVALID_ARGUMENT);
  EXPECT_STREQ(lkao_last_error(), "lkao_scene_create_of_instances: instances must not be NULL");
  instances_[1].size += 8;
  EXPECT_NE(lkao_scene_create_of_instances(meshes.data(), 1, instances_.data(), 2, 0, &scene), LKAO_OK);
  instances_[1].size -= 8;
  instances_[0].mesh = 1;
  EXPECT_EQ(lkao_scene_create_of_instances(meshes.data(), 1, instances_.data(), 1, 0, &scene),
            LKAO_ERROR_INVALID_ARGUMENT);
  const OwnedScene good = c_scene(first_);
  lkao_instance instance = LKAO_INSTANCE_INIT;
  EXPECT_EQ(lkao_scene_get_instance(good.get(), 1, &instance), LKAO_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(lkao_scene_set_groups(good.get(), 7, 1), LKAO_ERROR_INVALID_ARGUMENT);
  EXPECT_THAT(lkao_last_error(), testing::HasSubstr("7"));
  const std::uint32_t first = 0;
  float flat[12] = {};
  EXPECT_EQ(lkao_scene_move(good.get(), &first, flat, 0, 1, 0), LKAO_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(lkao_scene_move(good.get(), &first, flat, 44, 1, 0), LKAO_ERROR_INVALID_ARGUMENT);
  EXPECT_STREQ(lkao_last_error(), "lkao_scene_move: stride must be 0 or at least 48 bytes, not 44");
  lkao_mesh_instance no_mesh = LKAO_MESH_INSTANCE_INIT;
  EXPECT_EQ(lkao_scene_create_of_mesh_instances(&no_mesh, 1, nullptr, &scene), LKAO_ERROR_INVALID_ARGUMENT);
  EXPECT_STREQ(lkao_last_error(), "lkao_scene_create_of_mesh_instances: instances[0]->mesh must not be NULL");
}

}  // namespace
}  // namespace lkao
