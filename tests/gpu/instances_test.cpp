// Several meshes, and meshes in several places, as occluders.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <vector>

#include <glm/gtc/quaternion.hpp>

#include "gpu/in_furnished_room.h"
#include "support/instances.h"

namespace lkao::gl::tests::instances_test {
namespace {

using lkao::tests::random_point;
using lkao::tests::random_rotation;

Mesh small_pyramid() {
  return {{{-0.3f, 0, -0.3f}, {0.3f, 0, -0.3f}, {0.3f, 0, 0.3f}, {-0.3f, 0, 0.3f}, {0.05f, 0.7f, 0}},
          {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}, {1, 4, 2}, {2, 4, 3}, {3, 4, 0}}};
}

class InstancedOccluders : public InFurnishedRoom<64, 48> {
 protected:
  // The room where it is, a square, and some pyramids; of these every other one is mirrored.
  std::vector<MeshInstance> make_instances(std::uint64_t seed) const {
    lut::RandomStream random(seed);
    std::vector<MeshInstance> instances{{mesh_.positions, mesh_.triangles}};
    for (int i = 0; i < 8; ++i) {
      const glm::mat3 turn = glm::mat3_cast(random_rotation(random));
      const glm::vec3 scale(i % 2 == 0 ? 1.0f : -1.3f, 0.8f, 1.1f);
      const glm::vec3 place = glm::vec3(0, 1.2f, 0) + random_point(random, 1.5f);
      instances.push_back({pyramid_.positions, pyramid_.triangles,
                           glm::mat4x3(scale.x * turn[0], scale.y * turn[1], scale.z * turn[2], place)});
    }
    return instances;
  }

  // What a user without instances would do. The shader finds positions as CPUs do.
  std::vector<std::uint64_t> draw_flattened(const std::vector<MeshInstance>& instances, const RayOptions& options) {
    const Mesh flat = lkao::tests::flattened(instances);
    PassOnMesh pass = make_pass(flat, table_);
    return draw(pass, options);
  }

  Mesh pyramid_ = small_pyramid();
  PlaneMaskTable table_{SamplePattern::standard(64), {.resolution = 32}};
};

TEST_F(InstancedOccluders, BlockWhatTheFlattenedMeshBlocks) {
  const std::vector<MeshInstance> instances = make_instances(1);
  PassOnMesh room = make_pass(mesh_, table_);
  for (const Sidedness sidedness : {Sidedness::two_sided, Sidedness::one_sided}) {
    const RayOptions options{.radius = 0.8f, .sidedness = sidedness};
    PassOnMesh pass;
    pass.set_table(table_);
    pass.occluders = Occluders(instances);
    const auto masks = draw(pass, options);
    EXPECT_EQ(masks, draw_flattened(instances, options));
    EXPECT_NE(masks, draw(room, options)) << "no pyramid blocks anything";
  }
}

TEST_F(InstancedOccluders, MoveByTheirTransformsAlone) {
  const std::vector<MeshInstance> first = make_instances(2), second = make_instances(3);
  std::vector<glm::mat4x3> to_world;
  for (const MeshInstance& instance : second) to_world.push_back(instance.to_world);
  PassOnMesh pass;
  pass.set_table(table_);
  pass.occluders = Occluders(first);
  const RayOptions options{.radius = 0.8f, .sidedness = Sidedness::one_sided};
  const auto before = draw(pass, options);
  pass.occluders.update_transforms(to_world);
  const auto after = draw(pass, options);
  EXPECT_NE(before, after);
  EXPECT_EQ(after, draw_flattened(second, options));
}

TEST_F(InstancedOccluders, MayBeNoneOrEmpty) {
  PassOnMesh pass;
  pass.set_table(table_);
  pass.occluders = Occluders(std::span<const MeshInstance>());
  EXPECT_EQ(count_bits(draw(pass, {.radius = 0.8f})), 0u);
  const std::vector<MeshInstance> instances{{}, {mesh_.positions, mesh_.triangles}, {}};
  pass.occluders = Occluders(instances);
  EXPECT_EQ(draw(pass, {.radius = 0.8f}), draw_flattened(instances, {.radius = 0.8f}));
}

TEST_F(InstancedOccluders, AreTakenFromInterleavedArraysToo) {
  // Two meshes in one array: neither is the other.
  std::vector<glm::vec3> both;
  for (const glm::vec3& position : pyramid_.positions) both.insert(both.end(), {position, 0.5f * position});
  const PositionView packed(&both[0].x, pyramid_.positions.size());
  const PositionView large(&both[0].x, pyramid_.positions.size(), 2 * sizeof(glm::vec3));
  const PositionView small(&both[1].x, pyramid_.positions.size(), 2 * sizeof(glm::vec3));
  const glm::mat4x3 up(glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1), glm::vec3(0, 1, 0));
  const std::vector<MeshInstance> instances{
      {packed, pyramid_.triangles}, {large, pyramid_.triangles, up}, {small, pyramid_.triangles}};
  PassOnMesh pass;
  pass.set_table(table_);
  pass.occluders = Occluders(instances);
  const auto masks = draw(pass, {.radius = 2});
  EXPECT_EQ(masks, draw_flattened(instances, {.radius = 2}));
  EXPECT_GT(count_bits(masks), 0u);
}

TEST_F(InstancedOccluders, RefuseWhatTheyCannotBe) {
  using testing::HasSubstr;
  using testing::ThrowsMessage;
  std::vector<MeshInstance> instances = make_instances(4);
  Occluders occluders(instances), plain(mesh_.positions, mesh_.triangles);
  std::vector<glm::mat4x3> to_world;
  for (const MeshInstance& instance : instances) to_world.push_back(instance.to_world);
  EXPECT_THAT([&] { plain.update_transforms(to_world); },
              ThrowsMessage<std::runtime_error>(HasSubstr("no instances: update_positions()")));
  EXPECT_THAT([&] { occluders.update_positions(mesh_.positions); },
              ThrowsMessage<std::runtime_error>(HasSubstr("update_transforms()")));
  to_world[3][2] = -to_world[3][2];
  EXPECT_THAT([&] { occluders.update_transforms(to_world); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("to_world of instance 3 mirrors")));
  to_world[1][0][1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT([&] { occluders.update_transforms(to_world); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("to_world of instance 1 has nan in column 0")));
  to_world.pop_back();
  EXPECT_THAT([&] { occluders.update_transforms(to_world); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("9 instances to move, not 8")));
  const std::vector<glm::uvec3> beyond{{0, 1, 5}};
  instances[2].triangles = beyond;
  EXPECT_THAT([&] { Occluders refused(instances); }, ThrowsMessage<std::invalid_argument>(HasSubstr("5")));
}

}  // namespace
}  // namespace lkao::gl::tests::instances_test
