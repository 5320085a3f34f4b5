// Scenes that change, what is refused, and what copies share.
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lkao/lkao.h"
#include "support/brute_force.h"
#include "support/instances.h"
#include "support/receivers.h"

namespace lkao::occluder_scene_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using tests::Mesh;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

glm::mat4x3 at(const glm::vec3& place, float scale = 0.3f) { return tests::transform(glm::mat3(scale), place); }

// Balls on a grid.
struct Balls {
  Balls() {
    for (int i = 0; i < 64; ++i) {
      const glm::vec3 place(i % 4, i / 4 % 4, i / 16);
      instances.push_back({0, at(place)});
    }
  }

  OccluderScene scene() const { return {{OccluderBvh(ball.view(), {.keep_zero_area = true})}, instances}; }

  // All that the scene's instances stand for, with other balls in the place of the mesh where there are.
  Mesh flattened(const OccluderScene& scene, const Mesh& mesh) const {
    std::vector<MeshInstance> views;
    for (std::uint32_t i = 0; i < scene.instance_count(); ++i) {
      views.push_back(tests::instance_of(mesh, scene.instance(i).to_world));
    }
    return tests::flattened(views);
  }

  void expect_right(const OccluderScene& scene, const Mesh& mesh) const {
    const Mesh all = flattened(scene, mesh);
    const RayOptions options{.radius = 0.9f};
    const AmbientOcclusion ao(scene, SamplePattern::standard(64), options);
    int blocked_count = 0;
    for (std::uint64_t i = 0; i < receivers.size(); ++i) {
      const OcclusionMask mask = ao.blocked(receivers[i], i);
      ASSERT_EQ(mask, tests::brute_force_mask(all.view(), ao.rays(receivers[i], i), options)) << i;
      blocked_count += mask.count();
    }
    EXPECT_GT(blocked_count, 100);
  }

  Mesh ball = tests::closed_sphere(8, 6);
  std::vector<OccluderInstance> instances;
  std::vector<Receiver> receivers = tests::random_receivers(30, 3, 41);
};

TEST(OccluderScene, KnowsWhatItHolds) {
  const Balls balls;
  const OccluderScene scene = balls.scene();
  EXPECT_EQ(scene.mesh_count(), 1u);
  EXPECT_EQ(scene.instance_count(), 64u);
  EXPECT_EQ(scene.occluder_count(), 64 * balls.ball.triangles.size());
  EXPECT_EQ(scene.instance(5).to_world, balls.instances[5].to_world);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(scene.bounds().lower[axis], -0.3f, 0.02f);
    EXPECT_NEAR(scene.bounds().upper[axis], 3.3f, 0.02f);
  }
  EXPECT_THROW(scene.instance(64), std::out_of_range);
  EXPECT_THROW(scene.mesh(1), std::out_of_range);
  // Its mesh is there once.
  EXPECT_LT(scene.memory_bytes(), scene.mesh(0).report().memory_bytes + 64 * 350);
}

TEST(OccluderScene, OfNothingBlocksNothing) {
  const OccluderScene none(std::vector<OccluderBvh>{}, {});
  EXPECT_GT(none.bounds().lower.x, none.bounds().upper.x);
  const AmbientOcclusion ao(none, SamplePattern::standard(64), {.radius = kInfinity});
  EXPECT_EQ(ao.query({.normal = {0, 0, 1}}, 0).occlusion, 0);
  const OccluderScene empty_mesh({OccluderBvh({})}, std::vector<OccluderInstance>{{0, at({1, 2, 3})}, {}});
  const AmbientOcclusion other(empty_mesh, SamplePattern::standard(64), {.radius = 1});
  EXPECT_EQ(other.query({.normal = {0, 0, 1}}, 0).occlusion, 0);
}

TEST(OccluderScene, SharesMeshesOfTheSameArrays) {
  const Mesh a = tests::closed_box(), b = tests::closed_box();
  const std::vector<glm::uvec3> half(a.triangles.begin(), a.triangles.begin() + 6);
  const std::vector<MeshInstance> views{{a.positions, a.triangles},
                                        {b.positions, b.triangles},
                                        {a.positions, a.triangles, at({1, 0, 0})},
                                        {a.positions, half}};
  const OccluderScene scene(views);
  EXPECT_EQ(scene.mesh_count(), 3u);
  EXPECT_EQ(scene.instance(2).mesh, scene.instance(0).mesh);
  EXPECT_EQ(scene.occluder_count(), 3 * 12u + 6);
}

TEST(OccluderScene, MovesItsInstances) {
  const Balls balls;
  OccluderScene scene = balls.scene();
  balls.expect_right(scene, balls.ball);
  lut::RandomStream random(42);
  // A little, then so far that the hierarchy is built anew.
  for (const float distance : {0.2f, 3.0f}) {
    std::vector<InstanceMove> moves;
    for (std::uint32_t i = 0; i < 64; i += 3) {
      const glm::vec3 place = scene.instance(i).to_world[3] + tests::random_point(random, distance);
      moves.push_back({i, tests::random_transform(random, glm::vec3(0.3f, 0.2f, 0.4f), place)});
    }
    scene.move(moves);
    for (const InstanceMove& move : moves) EXPECT_EQ(scene.instance(move.instance).to_world, move.to_world);
    balls.expect_right(scene, balls.ball);
  }
}

// What a query was given stays as it was.
TEST(OccluderScene, ChangesForItselfAlone) {
  const Balls balls;
  OccluderScene scene = balls.scene();
  const OccluderScene copy = scene;
  const AmbientOcclusion ao(scene, SamplePattern::standard(64), {.radius = 0.25f});
  const Receiver inside{.position = {0, 0, 0}, .normal = {0, 0, 1}};
  const float before = ao.query(inside, 0).occlusion;
  EXPECT_EQ(AmbientOcclusion(copy, SamplePattern::standard(64), {.radius = 0.5f}).query(inside, 0).occlusion, 1);
  scene.move(std::vector<InstanceMove>{{0, at({9, 9, 9})}});
  scene.set_groups(1, 0);
  EXPECT_EQ(ao.query(inside, 0).occlusion, before);
  EXPECT_EQ(copy.instance(0).to_world, balls.instances[0].to_world);
  EXPECT_EQ(copy.instance(1).groups, kAllGroups);
  EXPECT_EQ(AmbientOcclusion(scene, SamplePattern::standard(64), {.radius = 0.5f}).query(inside, 0).occlusion, 0);
}

TEST(OccluderScene, TakesAnotherMesh) {
  const Balls balls;
  OccluderScene scene = balls.scene();
  Mesh cube = tests::closed_box();
  scene.set_mesh(0, OccluderBvh(cube.view()));
  EXPECT_EQ(scene.occluder_count(), 64 * 12u);
  balls.expect_right(scene, cube);
}

TEST(OccluderScene, FollowsAMeshThatIsRefitted) {
  constexpr RefitOptions kNeverAnew{.max_growth = std::numeric_limits<double>::infinity()};
  const Balls balls;
  OccluderScene scene = balls.scene();
  const glm::vec3 nowhere(std::numeric_limits<float>::quiet_NaN());
  Mesh moved = balls.ball;
  for (glm::vec3& p : moved.positions) p *= 1.0f + 0.3f * p.x;
  moved.positions[3] = nowhere;  // its triangles rest
  scene.set_mesh(0, scene.mesh(0).refitted(moved.positions, kNeverAnew));
  balls.expect_right(scene, moved);
  // All of them, and they come back.
  const std::vector<glm::vec3> nothing(moved.positions.size(), nowhere);
  scene.set_mesh(0, scene.mesh(0).refitted(nothing, kNeverAnew));
  EXPECT_EQ(scene.occluder_count(), 0u);
  EXPECT_GT(scene.bounds().lower.x, scene.bounds().upper.x);
  scene.set_mesh(0, scene.mesh(0).refitted(balls.ball.positions, kNeverAnew));
  balls.expect_right(scene, balls.ball);
}

TEST(OccluderScene, TakesAMeshInThePlaceOfAnEmptyOne) {
  Balls balls;
  for (std::size_t i = 0; i < balls.instances.size(); i += 3) balls.instances[i].mesh = 1;
  OccluderScene scene({OccluderBvh(balls.ball.view()), OccluderBvh({})}, balls.instances);
  scene.set_mesh(1, scene.mesh(0));
  balls.expect_right(scene, balls.ball);
}

TEST(OccluderScene, RefusesWhatItCannotUseAndStaysAsItWas) {
  const Balls balls;
  OccluderScene scene = balls.scene();
  const glm::mat4x3 flat = tests::transform(glm::mat3({1, 0, 0}, {0, 0, 0}, {0, 0, 1}), {});
  glm::mat4x3 broken = at({1, 2, 3});
  broken[1][2] = std::numeric_limits<float>::quiet_NaN();
  const auto moved_to = [&](std::uint32_t instance, const glm::mat4x3& to_world) {
    return [&scene, instance, to_world] {
      scene.move(std::vector<InstanceMove>{{3, at({7, 7, 7})}, {instance, to_world}});
    };
  };
  using Wrong = std::invalid_argument;
  EXPECT_THAT(moved_to(4, flat), ThrowsMessage<Wrong>(HasSubstr("moves[1].to_world must be invertible")));
  EXPECT_THAT(moved_to(4, broken), ThrowsMessage<Wrong>(HasSubstr("moves[1].to_world must be finite")));
  EXPECT_THAT(moved_to(4, at({0, 2e18f, 0})), ThrowsMessage<Wrong>(HasSubstr("must not lead beyond 1e18")));
  EXPECT_THAT(moved_to(64, at({})), ThrowsMessage<Wrong>(HasSubstr("moves[1].instance is 64, and there are 64")));
  EXPECT_EQ(scene.instance(3).to_world, balls.instances[3].to_world);
  EXPECT_THROW(scene.set_groups(64, 1), std::out_of_range);
  EXPECT_THROW(scene.set_mesh(1, OccluderBvh({})), std::out_of_range);
  balls.expect_right(scene, balls.ball);

  const std::vector meshes{OccluderBvh(balls.ball.view())};
  const auto made_of = [&](const OccluderInstance& instance) {
    return [&meshes, instance] { OccluderScene(meshes, std::vector<OccluderInstance>{{}, instance}); };
  };
  EXPECT_THAT(made_of({1}), ThrowsMessage<Wrong>(HasSubstr("instances[1].mesh is 1, and there are 1 meshes")));
  EXPECT_THAT(made_of({0, flat}), ThrowsMessage<Wrong>(HasSubstr("instances[1].to_world must be invertible")));
  EXPECT_THAT(made_of({0, broken}), ThrowsMessage<Wrong>(HasSubstr("instances[1].to_world must be finite")));
  const std::vector<glm::dvec3> far{{1e7, 0, 0}, {1e7, 1, 0}, {1e7, 0, 1}};
  const std::vector<glm::uvec3> triangle{{0, 1, 2}};
  const OccluderBvh elsewhere({{far, {1e7, 0, 0}}, triangle});
  EXPECT_THAT(
      [&] {
        OccluderScene(std::vector{meshes[0], elsewhere}, {});
      },
      ThrowsMessage<Wrong>(HasSubstr("meshes[1] must have the origin of meshes[0]")));
}

// Batches enter the hierarchy over the instances below its root.
TEST(OccluderScene, AnswersBatchesAndNeighbourhoodsAsSingleQueries) {
  const Balls balls;
  const AmbientOcclusion ao(balls.scene(), SamplePattern::standard(256), {.radius = 0.5f});
  std::vector<Receiver> receivers = tests::random_receivers(200, 0.4f, 43);
  for (Receiver& receiver : receivers) receiver.position += glm::vec3(1.5f);
  std::vector<float> occlusion(receivers.size());
  ao.query(receivers, {.occlusion = occlusion});
  Neighbourhood near = ao.around({glm::vec3(1.1f), glm::vec3(1.9f)});
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const ReceiverOcclusion single = ao.query(receivers[i], i);
    ASSERT_EQ(occlusion[i], single.occlusion) << i;
    ASSERT_EQ(near.blocked(receivers[i], i), single.mask) << i;
  }
}

}  // namespace
}  // namespace lkao::occluder_scene_test
