// Scenes of instances: the bits of the one mesh that they stand for.
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "lkao/lkao.h"
#include "support/brute_force.h"
#include "support/instances.h"
#include "support/kernel_choice.h"
#include "support/receivers.h"
#include "support/sanitized.h"

namespace lkao::instances_test {
namespace {

using tests::instance_of;
using tests::Mesh;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

class Instances : public tests::OnEveryKernel {
 protected:
  // Each receiver's mask, by itself and in a batch, against every triangle of the flattened mesh; returns the number of
  // blocked rays.
  std::uint64_t expect_flattened_bits(const std::vector<MeshInstance>& instances,
                                      const std::vector<Receiver>& receivers, const RayOptions& options,
                                      int ray_count = 64) const {
    const Mesh all = tests::flattened(instances);
    const AmbientOcclusion ao(OccluderScene(instances), SamplePattern::standard(ray_count), options, GetParam().kernel);
    std::vector<std::uint64_t> batch(receivers.size() * static_cast<std::size_t>(ao.pattern().word_count()));
    ao.query(receivers, {.mask_words = batch});
    std::uint64_t blocked_count = 0;
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      const OcclusionMask mask = ao.blocked(receivers[i], i);
      for (int word = 0; word < ao.pattern().word_count(); ++word) {
        EXPECT_EQ(batch[i * static_cast<std::size_t>(ao.pattern().word_count()) + static_cast<std::size_t>(word)],
                  mask.words[word])
            << "receiver " << i << " of a batch";
      }
      const ReceiverRays rays = ao.rays(receivers[i], i);
      std::uint32_t excluded = receivers[i].excluded_primitive;
      for (std::uint32_t k = 0; k < receivers[i].excluded_instance && excluded != kNoPrimitive; ++k) {
        excluded += static_cast<std::uint32_t>(instances[k].triangles.size());
      }
      EXPECT_EQ(mask, tests::brute_force_mask(all.view(), rays, options, excluded)) << "receiver " << i;
      blocked_count += static_cast<std::uint64_t>(mask.count());
      if (testing::Test::HasFailure()) break;
    }
    return blocked_count;
  }
};

INSTANTIATE_TEST_SUITE_P(Kernels, Instances, testing::ValuesIn(tests::all_kernels()), tests::name_of_choice);

// Three meshes in a dozen places, `place` away from zero.
struct Crowd {
  explicit Crowd(const glm::vec3& scale, const glm::vec3& place = glm::vec3(0), float size = 1) {
    lut::RandomStream random(71);
    for (int i = 0; i < 12; ++i) {
      const float mirror = i % 3 == 1 ? -1.0f : 1.0f;
      const glm::vec3 s = glm::vec3(mirror * scale.x, scale.y, scale.z) * tests::uniform(random, 0.3f, 0.7f);
      instances.push_back(instance_of(meshes[static_cast<std::size_t>(i % 3)],
                                      tests::random_transform(random, s, place + tests::random_point(random, size))));
    }
    receivers = tests::with_exclusions(tests::random_receivers(30, size, 72), 4);
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      const glm::vec3 near = receivers[i].position / size;
      receivers[i].position =
          i % 2 == 0 ? receivers[i].position + place : tests::placed(instances[i % 12].to_world, near);
      receivers[i].excluded_instance = static_cast<std::uint32_t>(i % 12);
    }
  }

  std::array<Mesh, 3> meshes = {tests::random_soup(60, 0.5f, 73), tests::closed_sphere(12, 8), tests::closed_box()};
  std::vector<MeshInstance> instances;
  std::vector<Receiver> receivers;
};

TEST_P(Instances, HaveTheBitsOfTheFlattenedMesh) {
  const Crowd crowd(glm::vec3(1));
  for (const Sidedness sidedness : {Sidedness::two_sided, Sidedness::one_sided}) {
    for (const float radius : {0.2f, 1.0f, kInfinity}) {
      const RayOptions options{.radius = radius, .sidedness = sidedness};
      EXPECT_GT(expect_flattened_bits(crowd.instances, crowd.receivers, options, 256), 100u) << radius;
    }
  }
}

// Few rays of each receiver meet an instance there, and the numbers of rays fill batches in different ways.
TEST_P(Instances, HaveThemSeenFromAfar) {
  lut::RandomStream random(75);
  const std::array<Mesh, 2> meshes = {tests::random_soup(40, 0.9f, 76), tests::closed_sphere(8, 6)};
  std::vector<MeshInstance> instances;
  for (std::size_t i = 0; i < 24; ++i) {
    const glm::vec3 place = 4.0f * tests::random_point(random, 1);
    const glm::vec3 scale(i % 5 == 1 ? -0.4f : 0.4f, i % 7 == 2 ? 1e-3f : 0.4f, 0.5f);
    instances.push_back(instance_of(meshes[i % 2], tests::random_transform(random, scale, place)));
  }
  std::vector<Receiver> receivers = tests::random_receivers(tests::unless_sanitized(70, 20), 0.5f, 77);
  receivers[3].normal = glm::vec3(0);  // casts no ray
  for (const Sidedness sidedness : {Sidedness::two_sided, Sidedness::one_sided}) {
    for (const float radius : {5.0f, kInfinity}) {
      const RayOptions options{.radius = radius, .sidedness = sidedness};
      EXPECT_GT(expect_flattened_bits(instances, receivers, options, 100), 100u) << radius;
    }
  }
  receivers.resize(10);
  EXPECT_GT(expect_flattened_bits(instances, receivers, {.radius = 9}, 1024), 100u);
}

TEST_P(Instances, HaveThemUnderAnyStretch) {
  for (const glm::vec3& scale : {glm::vec3(1, 0.001f, 1), glm::vec3(1, 1000, 0.5f), glm::vec3(1e-6f), glm::vec3(1e6f),
                                 glm::vec3(1, 1e-5f, 1), glm::vec3(1, 1e4f, 1), glm::vec3(1e-20f, 1, 1)}) {
    const float size = std::max({scale.x, scale.y, scale.z});
    const Crowd crowd(scale, glm::vec3(0), size);
    EXPECT_GT(expect_flattened_bits(crowd.instances, crowd.receivers, {.radius = size}), 10u) << scale.y;
  }
}

// There the corners are rounded to a sixteenth.
TEST_P(Instances, HaveThemFarFromZero) {
  for (const float scale : {1.0f, 30.0f}) {
    const Crowd crowd(glm::vec3(scale), glm::vec3(1e6f, -7e5f, 3e5f), scale);
    EXPECT_GT(expect_flattened_bits(crowd.instances, crowd.receivers, {.radius = scale}), 100u) << scale;
  }
}

TEST_P(Instances, HaveThemOnTheirOwnSurfaces) {
  const Crowd crowd(glm::vec3(1));
  const Mesh all = tests::flattened(crowd.instances);
  std::vector<Receiver> receivers;
  for (std::size_t i = 0; i < all.triangles.size(); i += 19) {
    const glm::uvec3 t = all.triangles[i];
    const glm::vec3 a = all.positions[t.x], b = all.positions[t.y], c = all.positions[t.z];
    receivers.push_back({.position = (a + b + c) / 3.0f, .normal = glm::cross(b - a, c - a)});
    receivers.push_back({.position = a, .normal = glm::cross(b - a, c - a)});
  }
  for (const float offset : {0.0f, kQuerySurfaceOffset}) {
    EXPECT_GT(expect_flattened_bits(crowd.instances, receivers, {.radius = 0.5f, .surface_offset = offset}), 100u);
  }
}

// Rays that begin later, and levels that end earlier.
TEST_P(Instances, AnswerPartsOfRays) {
  const Crowd crowd(glm::vec3(1, 0.2f, 1));
  const OccluderScene scene(crowd.instances);
  const OccluderBvh flat(tests::flattened(crowd.instances).view());
  const SamplePattern pattern = SamplePattern::standard(128).with_falloff(Falloff::linear());
  const RayOptions options{.radius = 0.8f, .surface_offset = 0, .min_distance = 0.05f};
  for (const float r_max : {0.3f, kInfinity}) {
    const AmbientOcclusion ao({{scene, 0.1f, r_max}, {flat, 0.5f}}, pattern, options, GetParam().kernel);
    const AmbientOcclusion expected({{flat, 0.1f, r_max}, {flat, 0.5f}}, pattern, options, Kernel::scalar);
    for (std::size_t i = 0; i < crowd.receivers.size(); ++i) {
      Receiver receiver = crowd.receivers[i];
      receiver.excluded_primitive = kNoPrimitive;
      ASSERT_EQ(ao.blocked(receiver, i), expected.blocked(receiver, i)) << i;
    }
  }
}

// Nothing comes in from outside, wherever the transform takes a closed mesh.
TEST_P(Instances, StayClosed) {
  lut::RandomStream random(81);
  const std::array<Mesh, 2> meshes = {tests::closed_sphere(40, 24), tests::closed_box()};
  const SamplePattern pattern = SamplePattern::standard(256);
  for (const Mesh& mesh : meshes) {
    for (const glm::vec3& scale : {glm::vec3(1), glm::vec3(-1, 1, 1), glm::vec3(1, 0.001f, 1), glm::vec3(1, 1000, 1)}) {
      for (const glm::vec3& place : {glm::vec3(0), glm::vec3(1e6f, -3e5f, 0)}) {
        const glm::mat4x3 to_world = tests::random_transform(random, 1000.0f * scale, place);
        const AmbientOcclusion ao(OccluderScene(std::vector{instance_of(mesh, to_world)}), pattern,
                                  {.radius = kInfinity, .surface_offset = 0}, GetParam().kernel);
        for (std::uint64_t i = 0; i < 12; ++i) {
          const glm::vec3 inside = tests::placed(to_world, tests::random_point(random, 0.3f));
          const Receiver receiver{.position = inside, .normal = tests::random_direction(random)};
          ASSERT_EQ(ao.query(receiver, i).occlusion, 1) << scale.y << ", " << place.x << ", " << i;
        }
      }
    }
  }
}

// Two walls meet at a corner that lies within the edge of a third: there a triangle without area closes what rounding
// opens elsewhere.
TEST_P(Instances, StayClosedAtTriangleWithoutArea) {
  Mesh mesh = tests::closed_box();
  // The face z = -1 is {0, 2, 1}, {1, 2, 3}; its edge from 2 to 1 gets a middle in the second triangle only.
  mesh.positions.emplace_back(0, 0, -1);
  mesh.triangles[1] = {1, 8, 3};
  mesh.triangles.emplace_back(8, 2, 3);
  mesh.triangles.emplace_back(1, 2, 8);
  lut::RandomStream random(82);
  for (int i = 0; i < 40; ++i) {
    const glm::mat4x3 to_world = tests::random_transform(random, glm::vec3(3, 0.7f, 1), glm::vec3(1e5f, 10, 0));
    const std::vector instances{instance_of(mesh, to_world)};
    // Rays aimed at the edge, from behind it.
    const glm::vec3 inside = tests::placed(to_world, glm::vec3(0.2f, 0.1f, 0.5f));
    const glm::vec3 target = tests::placed(to_world, glm::vec3(0, 0, -1));
    std::vector<Receiver> receivers;
    for (int k = 0; k < 6; ++k) receivers.push_back({.position = inside, .normal = target - inside});
    const AmbientOcclusion ao(OccluderScene(instances), SamplePattern::standard(1024), {.radius = 100},
                              GetParam().kernel);
    for (std::size_t k = 0; k < receivers.size(); ++k) ASSERT_EQ(ao.query(receivers[k], k).occlusion, 1);
    expect_flattened_bits(instances, receivers, {.radius = 100});
  }
}

TEST_P(Instances, BlockOnlyTheirGroups) {
  const Mesh box = tests::closed_box();
  const OccluderBvh mesh(box.view());
  const auto at = [](float x) { return tests::transform(glm::mat3(0.5f), {x, 0, 0}); };
  const OccluderScene scene({mesh}, std::vector<OccluderInstance>{{0, at(0), 1}, {0, at(1.5f), 2}, {0, at(4), 0}});
  const AmbientOcclusion ao(scene, SamplePattern::standard(64), {.radius = 1.5f}, GetParam().kernel);
  const auto occlusion = [&](float x, std::uint32_t groups) {
    const Receiver receiver{.position = {x, 0, 0}, .normal = {1, 0, 0}, .occluder_groups = groups};
    float in_batch = 2;
    ao.query({&receiver, 1}, {.occlusion = {&in_batch, 1}});
    EXPECT_EQ(in_batch, ao.query(receiver, 0).occlusion);
    return in_batch;
  };
  EXPECT_EQ(occlusion(0, kAllGroups), 1);
  EXPECT_EQ(occlusion(0, 1), 1);
  EXPECT_LT(occlusion(0, 2), 1);
  EXPECT_GT(occlusion(0, 2), 0);
  EXPECT_EQ(occlusion(0, 4), 0);
  EXPECT_EQ(occlusion(1.5f, 1), 0);
  EXPECT_EQ(occlusion(1.5f, 3), 1);
  EXPECT_EQ(occlusion(4, kAllGroups), 0) << "a receiver only";
  EXPECT_EQ(occlusion(0, 0), 0);
}

// A scene of one mesh where it is has groups too.
TEST_P(Instances, OfOneMeshHaveItsBits) {
  const Mesh mesh = tests::random_soup(500, 0.3f, 91);
  const OccluderBvh occluders(mesh.view());
  const SamplePattern pattern = SamplePattern::standard(128);
  const RayOptions options{.radius = 0.7f};
  const AmbientOcclusion plain(occluders, pattern, options, GetParam().kernel);
  const AmbientOcclusion scene(OccluderScene({occluders}, std::vector<OccluderInstance>(1)), pattern, options,
                               GetParam().kernel);
  const AmbientOcclusion views(OccluderScene(std::vector{instance_of(mesh)}), pattern, options, GetParam().kernel);
  const std::vector<Receiver> receivers = tests::with_exclusions(tests::random_receivers(50, 1, 92), 3);
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const OcclusionMask mask = plain.blocked(receivers[i], i);
    ASSERT_EQ(mask, tests::brute_force_mask(mesh.view(), plain.rays(receivers[i], i), options,
                                            receivers[i].excluded_primitive));
    ASSERT_EQ(scene.blocked(receivers[i], i), mask);
    ASSERT_EQ(views.blocked(receivers[i], i), mask);
    Receiver other = receivers[i];
    other.occluder_groups = 0;
    ASSERT_FALSE(plain.blocked(other, i).any());
    other = receivers[i];
    other.excluded_instance = 1;
    ASSERT_EQ(plain.blocked(other, i), tests::brute_force_mask(mesh.view(), plain.rays(other, i), options));
  }
}

TEST(InstancesByTable, HaveTheBitsOfTheFlattenedMesh) {
  const Crowd crowd(glm::vec3(1, 0.3f, 1), glm::vec3(100, 0, 0));
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32, .masks = PlaneMasks::must_may});
  const RayOptions options{.radius = 0.6f};
  const Mesh all = tests::flattened(crowd.instances);
  for (const NodeMasks node_masks : {NodeMasks::bounding_sphere, NodeMasks::box_outline}) {
    const AmbientOcclusion ao(OccluderScene(crowd.instances), table, options, node_masks);
    for (std::size_t i = 0; i < crowd.receivers.size(); ++i) {
      Receiver receiver = crowd.receivers[i];
      receiver.excluded_primitive = kNoPrimitive;
      ASSERT_EQ(ao.blocked(receiver, i), tests::brute_force_mask(all.view(), ao.rays(receiver, i), options));
    }
  }
}

}  // namespace
}  // namespace lkao::instances_test
