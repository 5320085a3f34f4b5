#include "bench/exact_rays.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "lkao/lkao.h"
#include "support/instances.h"
#include "support/meshes.h"
#include "support/receivers.h"

namespace lkao::bench {
namespace {

class Disagreements : public testing::TestWithParam<Sidedness> {};

// Random triangles, as they are and mirrored, and answers of which every ray's opposite is wrong.
TEST_P(Disagreements, AreDecidedForWhoIsRight) {
  lut::RandomStream random(7);
  const tests::Mesh mesh = tests::random_soup(60, 1, 5);
  const glm::mat4x3 mirror = tests::random_transform(random, {-1, 2, 1}, {0.5f, 0, 0});
  const std::vector<OccluderInstance> instances = {
      {.mesh = 0}, {.mesh = 0, .to_world = mirror, .groups = 1}, {.mesh = 0, .groups = 0}};
  const OccluderScene scene({OccluderBvh(mesh.view())}, instances);
  const AmbientOcclusion ao(scene, SamplePattern::standard(64), {.radius = 0.7f, .sidedness = GetParam()});
  const std::vector<Receiver> receivers = tests::with_exclusions(tests::random_receivers(30, 1, 3), 4);
  std::vector<std::uint64_t> masks(receivers.size()), opposite;
  ao.query(receivers, {.mask_words = masks});
  std::uint64_t cast = 0, blocked = 0;
  ReceiverRays rays;
  for (std::size_t k = 0; k < receivers.size(); ++k) {
    ao.rays(receivers[k], k, rays);
    opposite.push_back(masks[k] ^ rays.cast.words[0]);
    cast += static_cast<std::uint64_t>(std::popcount(rays.cast.words[0]));
    blocked += static_cast<std::uint64_t>(std::popcount(masks[k]));
  }
  ASSERT_GT(blocked, cast / 10);
  ASSERT_LT(blocked, cast - cast / 10);

  const Disagreement none = decide_exactly(ao, receivers, masks, masks);
  EXPECT_EQ(none.first_wrong + none.second_wrong + none.undecided, 0u);
  const Disagreement second = decide_exactly(ao, receivers, masks, opposite);
  EXPECT_EQ(second.second_wrong, cast);
  EXPECT_EQ(second.first_wrong + second.undecided, 0u);
  const Disagreement first = decide_exactly(ao, receivers, opposite, masks);
  EXPECT_EQ(first.first_wrong, cast);
  EXPECT_EQ(first.second_wrong + first.undecided, 0u);
}

INSTANTIATE_TEST_SUITE_P(All, Disagreements, testing::Values(Sidedness::two_sided, Sidedness::one_sided));

// A ray straight up, through the edge that two triangles share.
TEST(Disagreement, IsLeftUndecidedOnAnEdge) {
  const tests::Mesh roof = {{{-1, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0, -1, 1}}, {{0, 1, 2}, {1, 0, 3}}};
  const OccluderScene scene({OccluderBvh(roof.view())}, std::vector<OccluderInstance>(1));
  const AmbientOcclusion ao(scene, SamplePattern::from_disk(std::vector<glm::vec2>(1), std::vector<float>{1}),
                            {.radius = 2});
  const std::vector<Receiver> receivers = {{.normal = {0, 0, 1}}};
  const std::vector<std::uint64_t> open = {0}, blocked = {1};
  const Disagreement found = decide_exactly(ao, receivers, open, blocked);
  EXPECT_EQ(found.undecided, 1u);
  EXPECT_EQ(found.first_wrong + found.second_wrong, 0u);
}

}  // namespace
}  // namespace lkao::bench
