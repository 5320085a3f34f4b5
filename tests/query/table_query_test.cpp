// Queries by look-ups in the plane mask table, against the scalar exact kernel.
#include <cmath>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

#include "lkao/lkao.h"
#include "support/meshes.h"
#include "support/receivers.h"
#include "support/sanitized.h"

namespace lkao {
namespace {

class TableQuery
    : public testing::TestWithParam<std::tuple<std::pair<int, float>, Sidedness, PlaneAddressing, NodeMasks>> {};

INSTANTIATE_TEST_SUITE_P(Soups, TableQuery,
                         testing::Combine(testing::Values(std::pair(3, 2.0f), std::pair(300, 0.2f),
                                                          std::pair(5000, 0.03f)),
                                          testing::Values(Sidedness::two_sided, Sidedness::one_sided),
                                          testing::Values(PlaneAddressing::cube, PlaneAddressing::slices),
                                          testing::Values(NodeMasks::bounding_sphere, NodeMasks::box_outline)));

// Must/may masks leave nothing to chance: the bits of the scalar kernel, for every addressing and node mask.
TEST_P(TableQuery, MustMayEqualsTheScalarKernel) {
  const auto [soup, sidedness, addressing, node_masks] = GetParam();
  const tests::Mesh mesh = tests::random_soup(soup.first, soup.second, 91);
  const OccluderBvh occluders(mesh.view());
  const std::vector<Receiver> receivers = tests::random_receivers(tests::unless_sanitized(40, 10), 1, 92);
  for (const Falloff& falloff : {Falloff::constant(), Falloff::linear()}) {
    const SamplePattern pattern = SamplePattern::standard(128).with_falloff(falloff);
    const PlaneMaskTable table(pattern, {.resolution = 32, .addressing = addressing, .masks = PlaneMasks::must_may});
    for (float radius : {0.05f, 0.5f, 5.0f}) {
      const RayOptions options{.radius = radius, .sidedness = sidedness};
      const AmbientOcclusion exact(occluders, pattern, options), by_table(occluders, table, options, node_masks);
      for (std::size_t i = 0; i < receivers.size(); ++i) {
        ASSERT_EQ(by_table.query(receivers[i], i).mask, exact.query(receivers[i], i).mask)
            << falloff.name() << ", radius " << radius << ", receiver " << i;
      }
    }
  }
}

// Made once for many tests.
const PlaneMaskTable& nearest_masks(PlaneAddressing addressing) {
  const auto make = [](PlaneAddressing by) {
    return PlaneMaskTable(SamplePattern::standard(128),
                          {.resolution = 128, .addressing = by, .masks = PlaneMasks::nearest});
  };
  static const PlaneMaskTable cube = make(PlaneAddressing::cube), slices = make(PlaneAddressing::slices);
  return addressing == PlaneAddressing::cube ? cube : slices;
}

// Nearest cells err by the size of a cell. In a soup every edge is an outline, and the mean error is still below one
// ray.
TEST_P(TableQuery, NearestIsClose) {
  const auto [soup, sidedness, addressing, node_masks] = GetParam();
  const tests::Mesh mesh = tests::random_soup(soup.first, soup.second, 93);
  const OccluderBvh occluders(mesh.view());
  const RayOptions options{.radius = 0.5f, .sidedness = sidedness};
  const AmbientOcclusion exact(occluders, SamplePattern::standard(128), options),
      by_table(occluders, nearest_masks(addressing), options, node_masks);
  const std::vector<Receiver> receivers = tests::random_receivers(300, 1, 94);
  double error = 0, signed_error = 0;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const double difference = static_cast<double>(by_table.query(receivers[i], i).occlusion) -
                              static_cast<double>(exact.query(receivers[i], i).occlusion);
    error += std::fabs(difference), signed_error += difference;
  }
  const auto count = static_cast<double>(receivers.size());
  EXPECT_LT(error / count, 1.5 / 128);
  EXPECT_LT(std::fabs(signed_error) / count, 0.5 / 128);
}

TEST(TableQuery, ClosedBoxDoesNotLeak) {
  const tests::Mesh box = tests::closed_box();
  const PlaneMaskTable table(SamplePattern::standard(256), {.resolution = 64});
  const AmbientOcclusion ao(OccluderBvh(box.view()), table, {.radius = 10});
  lut::RandomStream random(95);
  for (std::uint64_t i = 0; i < 2000; ++i) {
    ASSERT_EQ(ao.query({.position = tests::random_point(random, 0.99f), .normal = tests::random_direction(random)}, i)
                  .occlusion,
              1.0f);
  }
}

}  // namespace
}  // namespace lkao
