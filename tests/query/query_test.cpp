#include "lkao/ambient_occlusion.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "support/brute_force.h"
#include "support/meshes.h"

namespace lkao {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

AmbientOcclusion query_of(const tests::Mesh& mesh, const RayOptions& options, int ray_count = 128) {
  return {OccluderBvh(mesh.view()), SamplePattern::standard(ray_count), options};
}

template <typename Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Query, NamesABadOption) {
  const auto error_with = [](const RayOptions& options) {
    return error_of([&] { query_of(tests::closed_box(), options); });
  };
  const std::string radius = "radius must be greater than 0 and at most 1e18, or infinity, not ";
  EXPECT_EQ(error_with({.radius = 1}), "");
  EXPECT_EQ(error_with({.radius = INFINITY}), "");
  EXPECT_EQ(error_with({}), radius + "0");
  EXPECT_EQ(error_with({.radius = -1}), radius + "-1");
  EXPECT_EQ(error_with({.radius = -INFINITY}), radius + "-inf");
  EXPECT_EQ(error_with({.radius = kNaN}), radius + "nan");
  EXPECT_EQ(error_with({.radius = 0x1p60f}), radius + "1.152921504606847e+18");
  EXPECT_EQ(error_with({.radius = 1, .jitter = {.rotation = 2}}), "jitter.rotation must be in [0, 1] turns, not 2");
  EXPECT_EQ(error_with({.radius = 1, .jitter = {.tilt = -0.5f}}), "jitter.tilt must be in [0, pi/2] radians, not -0.5");
  EXPECT_EQ(error_with({.radius = 1, .surface_offset = -2}),
            "surface_offset must be finite and at least 0, or automatic (-1), not -2");
  EXPECT_EQ(error_with({.radius = 1, .surface_offset = kNaN}),
            "surface_offset must be finite and at least 0, or automatic (-1), not nan");
}

TEST(Query, NamesOutputsOfTheWrongSize) {
  const AmbientOcclusion ao = query_of(tests::closed_box(), {.radius = 1});
  const std::vector<Receiver> receivers(3, {.position = {}, .normal = {0, 0, 1}});
  std::vector<float> occlusion(2);
  std::vector<glm::vec3> bent_normals(4);
  std::vector<std::uint64_t> words(3);
  const auto error_with = [&](const QueryOutputs& outputs) { return error_of([&] { ao.query(receivers, outputs); }); };
  EXPECT_EQ(error_with({.occlusion = occlusion}), "outputs.occlusion has 2 entries, not 0 or 3");
  EXPECT_EQ(error_with({.bent_normals = bent_normals}), "outputs.bent_normals has 4 entries, not 0 or 3");
  EXPECT_EQ(error_with({.mask_words = words}), "outputs.mask_words has 3 entries, not 0 or 6");
  words.resize(6);
  EXPECT_EQ(error_with({.mask_words = words}), "");
}

TEST(Query, InvalidReceiversAnswerNaNAndAreCounted) {
  const AmbientOcclusion ao = query_of(tests::closed_box(), {.radius = 5});
  const std::vector<Receiver> receivers = {
      {.position = {}, .normal = {0, 0, 1}},
      {.position = {kNaN, 0, 0}, .normal = {0, 0, 1}},
      {.position = {0, INFINITY, 0}, .normal = {0, 0, 1}},
      {.position = {}, .normal = {0, 0, 0}},
      {.position = {}, .normal = {0, kNaN, 0}},
      {.position = {}, .normal = {0, 0, 1}, .geometric_normal = {0, kNaN, 0}},
      {.position = {}, .normal = {0, 0, 1}, .geometric_normal = {0, 0, -1}},
  };
  std::vector<float> occlusion(receivers.size());
  std::vector<std::uint64_t> words(receivers.size() * 2, 7);
  const QueryReport report = ao.query(receivers, {.occlusion = occlusion, .mask_words = words});
  EXPECT_EQ(report.receiver_count, receivers.size());
  EXPECT_EQ(report.invalid_receiver_count, receivers.size() - 1);
  EXPECT_EQ(report.ray_count, 128u);
  EXPECT_EQ(report.blocked_ray_count, 128u);
  EXPECT_EQ(occlusion[0], 1.0f);
  for (std::size_t i = 1; i < receivers.size(); ++i) {
    EXPECT_TRUE(std::isnan(occlusion[i])) << i;
    EXPECT_EQ(words[2 * i] | words[2 * i + 1], 0u) << i;
    EXPECT_TRUE(std::isnan(ao.query(receivers[i], i).bent_normal.x)) << i;
  }
}

// Normals of any length mean the same direction, even where their squares overflow or vanish in float.
TEST(Query, NormalsMayHaveAnyLength) {
  const AmbientOcclusion ao = query_of(tests::random_soup(300, 0.3f, 1), {.radius = 1});
  const OcclusionMask expected = ao.query({.position = {}, .normal = {1, 0, 0}}, 3).mask;
  for (float length : {1e-30f, 0.5f, 1e30f}) {
    EXPECT_EQ(ao.query({.position = {}, .normal = {length, 0, 0}}, 3).mask, expected) << length;
  }
}

// Every ray against every triangle, in soups of small and large triangles: bit for bit.
class QueryOfSoup : public testing::TestWithParam<std::tuple<int, float, Sidedness>> {};
INSTANTIATE_TEST_SUITE_P(Soups, QueryOfSoup,
                         testing::Combine(testing::Values(1, 10, 300, 3000), testing::Values(0.02f, 0.2f, 2.0f),
                                          testing::Values(Sidedness::two_sided, Sidedness::one_sided)),
                         [](const auto& soup) {
                           return fmt::format(
                               "Triangles{}Size{:.0f}Percent{}", std::get<0>(soup.param), 100 * std::get<1>(soup.param),
                               std::get<2>(soup.param) == Sidedness::two_sided ? "TwoSided" : "OneSided");
                         });

TEST_P(QueryOfSoup, EqualsBruteForce) {
  const auto [triangle_count, size, sidedness] = GetParam();
  const tests::Mesh mesh = tests::random_soup(triangle_count, size, 51);
  lut::RandomStream random(52);
  for (float radius : {0.05f, 0.5f, 5.0f}) {
    const AmbientOcclusion ao = query_of(mesh, {.radius = radius, .sidedness = sidedness});
    for (std::uint64_t index = 0; index < 8; ++index) {
      Receiver receiver{.position = tests::random_point(random, 1), .normal = tests::random_direction(random)};
      if (index % 2) receiver.geometric_normal = receiver.normal + tests::random_direction(random) * 0.5f;
      if (index % 4 == 3)
        receiver.excluded_primitive = static_cast<std::uint32_t>(random.next_below(mesh.triangles.size()));
      ASSERT_EQ(ao.query(receiver, index).mask, tests::brute_force_mask(mesh.view(), ao.rays(receiver, index),
                                                                        ao.options(), receiver.excluded_primitive));
    }
  }
}

TEST(Query, BuildOptionsChangeNoBit) {
  const tests::Mesh mesh = tests::random_soup(2000, 0.5f, 53);
  const AmbientOcclusion split(OccluderBvh(mesh.view()), SamplePattern::standard(256), {.radius = 0.7f});
  const AmbientOcclusion plain(OccluderBvh(mesh.view(), {.spatial_splits = false}), SamplePattern::standard(256),
                               {.radius = 0.7f});
  lut::RandomStream random(54);
  for (std::uint64_t index = 0; index < 100; ++index) {
    const Receiver receiver{.position = tests::random_point(random, 1), .normal = tests::random_direction(random)};
    ASSERT_EQ(split.query(receiver, index).mask, plain.query(receiver, index).mask);
  }
}

TEST(Query, ExcludedPrimitiveBlocksNothing) {
  tests::Mesh mesh;
  tests::add_quad(mesh, {-1, -1, 1}, {2, 0, 0}, {0, 2, 0});
  const AmbientOcclusion ao = query_of(mesh, {.radius = 10});
  Receiver receiver{.position = {}, .normal = {0, 0, 1}};
  const OcclusionMask both = ao.query(receiver, 0).mask;
  receiver.excluded_primitive = 0;
  const OcclusionMask second = ao.query(receiver, 0).mask;
  receiver.excluded_primitive = 1;
  const OcclusionMask first = ao.query(receiver, 0).mask;
  EXPECT_GT(first.count(), 0);
  EXPECT_GT(second.count(), 0);
  EXPECT_EQ(first | second, both);
  EXPECT_LT(first.count(), both.count());
}

TEST(Query, BentNormalPointsAwayFromTheWall) {
  tests::Mesh wall;
  tests::add_quad(wall, {0, 0, -100}, {0, 100, 0}, {0, 0, 200});
  const AmbientOcclusion ao = query_of(wall, {.radius = 50}, 1024);
  const ReceiverOcclusion answer = ao.query({.position = {1e-3f, 0, 0}, .normal = {0, 1, 0}}, 0);
  EXPECT_NEAR(glm::length(answer.bent_normal), 1, 1e-5);
  // Mean of the cosine-weighted directions with x > 0 is (4 / (3 pi), 2 / 3, 0), normalised.
  EXPECT_NEAR(answer.bent_normal.x, 0.537, 0.03);
  EXPECT_NEAR(answer.bent_normal.y, 0.844, 0.03);
  const AmbientOcclusion closed = query_of(tests::closed_box(), {.radius = 50});
  EXPECT_EQ(closed.query({.position = {}, .normal = {0, 2, 0}}, 0).bent_normal, glm::vec3(0, 1, 0));
}

// No receiver on a surface blocks itself: turned, tiny, huge and far planes, positions rounded to float.
TEST(Query, SurfacesDoNotBlockThemselves) {
  lut::RandomStream random(55);
  for (int i = 0; i < 300; ++i) {
    const float scale = std::pow(10.0f, tests::uniform(random, -3, 3));
    const glm::quat turn = tests::random_rotation(random);
    const glm::vec3 offset = tests::random_direction(random) * scale * std::pow(10.0f, tests::uniform(random, -1, 4));
    tests::Mesh plane;
    tests::add_quad(plane, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
    for (glm::vec3& p : plane.positions) p = turn * p * scale + offset;
    const AmbientOcclusion ao = query_of(plane, {.radius = scale}, 64);
    const glm::dvec3 a(plane.positions[0]), b(plane.positions[1]), c(plane.positions[2]);
    const glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    for (int k = 0; k < 30; ++k) {
      double u = random.next_double(), v = random.next_double();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Receiver receiver{.position = a + u * (b - a) + v * (c - a), .normal = k % 2 ? normal : -normal};
      // The two halves of the quad are rounded to slightly different planes: ask about the receiver's own.
      Receiver own = receiver;
      own.excluded_primitive = 1;
      ASSERT_EQ(ao.query(own, static_cast<std::uint64_t>(k)).occlusion, 0.0f) << i;
    }
  }
}

}  // namespace
}  // namespace lkao
