// Single queries from within a box: the answers of the query, whatever the box.
#include "lkao/neighbourhood.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <glm/common.hpp>

#include "lkao/lkao.h"
#include "support/meshes.h"
#include "support/receivers.h"
#include "support/sanitized.h"

namespace lkao::neighbourhood_test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

Bounds box_around(const glm::vec3& center, float half_size) { return {center - half_size, center + half_size}; }

// Most receivers inside of the box, some at its faces, some outside.
std::vector<Receiver> receivers_near(const Bounds& box, std::uint64_t seed) {
  std::vector<Receiver> receivers =
      tests::with_exclusions(tests::random_receivers(tests::unless_sanitized(60, 15), 1, seed), 4);
  const glm::vec3 size = box.upper - box.lower;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    glm::vec3& p = receivers[i].position;
    if (i % 7 == 0) continue;
    p = box.lower + size * (0.5f * p + 0.5f);
    if (i % 5 == 0) p.x = box.upper.x;
  }
  return receivers;
}

void expect_equal_answers(const AmbientOcclusion& ao, const Bounds& box) {
  const std::vector<Receiver> receivers = receivers_near(box, 5);
  Neighbourhood here = ao.around(box);
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const ReceiverOcclusion expected = ao.query(receivers[i], i), answer = here.query(receivers[i], i);
    ASSERT_EQ(answer.mask, expected.mask) << "receiver " << i;
    ASSERT_EQ(answer.occlusion, expected.occlusion);
    ASSERT_EQ(answer.bent_normal, expected.bent_normal);
    ASSERT_EQ(here.blocked(receivers[i], i), expected.mask);
    ASSERT_EQ(ao.blocked(receivers[i], i), expected.mask);
  }
}

TEST(Neighbourhood, AnswersAsTheQuery) {
  const tests::Mesh mesh = tests::random_soup(4000, 0.05f, 3);
  const OccluderBvh occluders(mesh.view());
  for (const int ray_count : {64, 128, 1024}) {
    for (const float radius : {0.02f, 0.3f, kInfinity}) {
      for (const Kernel kernel : {Kernel::simd, Kernel::scalar}) {
        SCOPED_TRACE(testing::Message() << ray_count << " rays, radius " << radius);
        const AmbientOcclusion ao(occluders, SamplePattern::standard(ray_count), {.radius = radius, .seed = 9}, kernel);
        for (const float half_size : {0.0f, 0.05f, 2.0f}) {
          expect_equal_answers(ao, box_around({0.3f, -0.2f, 0.4f}, half_size));
        }
      }
    }
  }
}

TEST(Neighbourhood, AnswersAsTheQueryWithLevelsAndTables) {
  const tests::Mesh mesh = tests::random_soup(2000, 0.1f, 4);
  const OccluderBvh occluders(mesh.view());
  const Bounds box = box_around({-0.1f, 0.2f, 0}, 0.1f);
  expect_equal_answers({{{occluders, 0, 0.2f}, {occluders, 0.2f}}, SamplePattern::standard(128), {.radius = 0.7f}},
                       box);
  expect_equal_answers({occluders, PlaneMaskTable(SamplePattern::standard(64), {.resolution = 32}), {.radius = 0.7f}},
                       box);
}

// The surface offset may move a ray's origin out of the box of positions.
TEST(Neighbourhood, CountsWithTheSurfaceOffset) {
  const tests::Mesh mesh = tests::random_soup(2000, 0.05f, 6);
  const AmbientOcclusion ao(OccluderBvh(mesh.view()), SamplePattern::standard(128),
                            {.radius = 0.05f, .surface_offset = 1e5f});
  expect_equal_answers(ao, box_around({0.3f, 0.1f, -0.2f}, 0.001f));
}

TEST(Neighbourhood, OutlivesTheQueryAndMoves) {
  const tests::Mesh mesh = tests::random_soup(500, 0.2f, 7);
  const Receiver receiver{.position = {0, 0, 0}, .normal = {0, 0, 1}};
  const auto make = [&] {
    return AmbientOcclusion(OccluderBvh(mesh.view()), SamplePattern::standard(64), {.radius = 1});
  };
  Neighbourhood here = make().around(box_around(glm::vec3(0), 0.1f));
  Neighbourhood moved = std::move(here);
  EXPECT_EQ(moved.blocked(receiver, 3), make().query(receiver, 3).mask);
}

TEST(Neighbourhood, AnswersUnusableReceiversWithNan) {
  const tests::Mesh mesh = tests::random_soup(100, 0.2f, 8);
  const AmbientOcclusion ao(OccluderBvh(mesh.view()), SamplePattern::standard(64), {.radius = 1});
  Neighbourhood here = ao.around(box_around(glm::vec3(0), 1));
  EXPECT_TRUE(std::isnan(here.query({.position = glm::vec3(0), .normal = glm::vec3(0)}, 0).occlusion));
  EXPECT_TRUE(std::isnan(here.query({.position = glm::vec3(kInfinity), .normal = {0, 0, 1}}, 0).occlusion));
}

TEST(Neighbourhood, RefusesWhatIsNoBox) {
  const AmbientOcclusion ao(OccluderBvh(TriangleMesh{}), SamplePattern::standard(64), {.radius = 1});
  const glm::vec3 zero(0), one(1);
  for (const Bounds& bad : {Bounds{one, zero}, Bounds{zero, glm::vec3(kInfinity)}, Bounds{glm::vec3(NAN), one}}) {
    EXPECT_THROW(ao.around(bad), std::invalid_argument);
  }
  EXPECT_FALSE(ao.around({zero, zero}).blocked({.position = zero, .normal = {0, 0, 1}}, 0).any());
}

}  // namespace
}  // namespace lkao::neighbourhood_test
