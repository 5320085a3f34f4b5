// What one receiver's rays met may be tried first for the next receivers: their bits must not depend on it, whoever
// they are, in whatever order they come, and whichever primitive they exclude.
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "needles.h"
#include "ray_counts.h"
#include "same_bits.h"

namespace lkao::tests::neighbours_test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
// Rooms are 2 wide and that far apart.
constexpr glm::vec3 kNextRoom(3, 1, -2);

void append(Mesh& mesh, const Mesh& part, const glm::vec3& offset) {
  const auto first = static_cast<unsigned>(mesh.positions.size());
  for (const glm::vec3& p : part.positions) mesh.positions.push_back(p + offset);
  for (const glm::uvec3& t : part.triangles) mesh.triangles.push_back(t + first);
}

// Closed rooms with furniture. The walls come first: 12 triangles a room.
Mesh rooms(int count, std::uint64_t seed) {
  Mesh mesh;
  for (int room = 0; room < count; ++room) append(mesh, closed_box(), static_cast<float>(room) * kNextRoom);
  for (int room = 0; room < count; ++room) {
    Mesh furniture = random_soup(150, 0.15f, seed + static_cast<std::uint64_t>(room));
    for (glm::vec3& p : furniture.positions) p *= 0.8f;
    append(mesh, furniture, static_cast<float>(room) * kNextRoom);
  }
  return mesh;
}

class Neighbours : public testing::TestWithParam<int> {
 protected:
  // By turns in one room and the other, in runs of `run_length`; every tenth beyond both.
  std::vector<Receiver> receivers(int count, int run_length) {
    std::vector<Receiver> all;
    for (int i = 0; i < count; ++i) {
      const glm::vec3 room = static_cast<float>(i / run_length % 2) * kNextRoom;
      const glm::vec3 place = random_point(random_, i % 10 == 9 ? 5.0f : 0.95f);
      all.push_back({.position = room + place, .normal = random_direction(random_)});
    }
    return all;
  }
  // As in a picture: each next to the one before.
  std::vector<Receiver> walk(int count) {
    std::vector<Receiver> all;
    glm::vec3 place(0), normal(0, 1, 0);
    for (int i = 0; i < count; ++i) {
      place = glm::clamp(place + random_point(random_, 0.05f), glm::vec3(-0.95f), glm::vec3(0.95f));
      normal = glm::normalize(normal + 0.2f * random_direction(random_));
      all.push_back({.position = place, .normal = normal});
    }
    return all;
  }
  const SamplePattern& pattern() const { return SamplePattern::standard(GetParam()); }
  int receiver_count() const { return GetParam() < 256 ? 300 : 140; }

  lut::RandomStream random_{71};
};

INSTANTIATE_TEST_SUITE_P(Rays, Neighbours, ray_counts({64, 192, 256, 1024}), testing::PrintToStringParamName());

TEST_P(Neighbours, InOtherRoomsChangeNothing) {
  const OccluderBvh occluders(rooms(2, 72).view());
  for (const float radius : {0.8f, 4.0f, kInfinity}) {
    for (const int run_length : {1, 17}) {
      const RayOptions options{.radius = radius,
                               .sidedness = run_length == 1 ? Sidedness::two_sided : Sidedness::one_sided};
      EXPECT_GT(expect_scalar_bits({{{occluders}}, pattern(), options, receivers(receiver_count(), run_length)}), 0u);
    }
  }
}

// Walls block most; each receiver may leave out another of them.
TEST_P(Neighbours, WithOtherExclusionsChangeNothing) {
  const OccluderBvh occluders(rooms(1, 73).view());
  for (const bool are_near : {false, true}) {
    std::vector<Receiver> asked = are_near ? walk(receiver_count()) : receivers(receiver_count(), 1000);
    for (Receiver& receiver : asked) {
      receiver.excluded_primitive =
          static_cast<std::uint32_t>(random_.next_below(random_.next_below(2) == 0 ? 12 : 160));
    }
    EXPECT_GT(expect_scalar_bits({{{occluders}}, pattern(), {.radius = 5}, asked}), 0u);
  }
}

// Each level has occluders of its own, of other numbers.
TEST_P(Neighbours, AtOtherDistancesChangeNothing) {
  const OccluderBvh fine(rooms(2, 74).view()), coarse(rooms(1, 75).view());
  for (const float radius : {4.0f, kInfinity}) {
    const std::vector<OccluderLevel> levels = {{fine, 0, 0.7f}, {coarse, 0.7f, 1.1f}, {fine, 1.1f}};
    EXPECT_GT(expect_scalar_bits({levels, pattern(), {.radius = radius}, receivers(receiver_count(), 9)}), 0u);
    EXPECT_GT(expect_scalar_bits({levels, pattern(), {.radius = radius}, walk(receiver_count())}), 0u);
  }
}

}  // namespace
}  // namespace lkao::tests::neighbours_test
