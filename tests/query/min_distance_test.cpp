// Rays that begin to count at a distance.
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bvh/ray_parts.h"
#include "lkao/lkao.h"
#include "support/brute_force.h"
#include "support/kernel_choice.h"
#include "support/meshes.h"
#include "support/receivers.h"

namespace lkao {
namespace {

class MinDistance : public tests::OnEveryKernel {
 protected:
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();
};

INSTANTIATE_TEST_SUITE_P(Kernels, MinDistance, testing::ValuesIn(tests::all_kernels()), tests::name_of_choice);

TEST_P(MinDistance, IsALevelThatBeginsThere) {
  const OccluderBvh occluders(tests::random_soup(400, 0.3f, 301).view());
  const std::vector<Receiver> receivers = tests::with_exclusions(tests::random_receivers(40, 1, 302), 4);
  int all_count = 0, blocked_count = 0;
  for (const Falloff& falloff : {Falloff::constant(), Falloff::linear()}) {
    const SamplePattern pattern = SamplePattern::standard(100).with_falloff(falloff);
    for (const float radius : {0.5f, 3.0f, kInfinity}) {
      const AmbientOcclusion all(occluders, pattern, {.radius = radius}, GetParam().kernel);
      for (const float min_distance : {1e-6f, 0.05f, 0.3f, 0.49f}) {
        const AmbientOcclusion ao(occluders, pattern, {.radius = radius, .min_distance = min_distance},
                                  GetParam().kernel);
        const AmbientOcclusion level({{occluders, min_distance}}, pattern, {.radius = radius}, GetParam().kernel);
        Neighbourhood around = ao.around({glm::vec3(-1), glm::vec3(1)});
        for (std::size_t i = 0; i < receivers.size(); ++i) {
          const OcclusionMask mask = ao.query(receivers[i], i).mask;
          ASSERT_EQ(mask, level.query(receivers[i], i).mask) << radius << ", " << min_distance << ", " << i;
          ASSERT_EQ(mask, around.blocked(receivers[i], i)) << i;
          ASSERT_FALSE((mask & ~all.query(receivers[i], i).mask).any()) << i;
          all_count += all.query(receivers[i], i).mask.count();
          blocked_count += mask.count();
        }
      }
    }
  }
  EXPECT_GT(blocked_count, all_count / 4);
  EXPECT_LT(blocked_count, all_count * 9 / 10);
}

TEST_P(MinDistance, IsTheBruteForceOfTheRestOfEachRay) {
  const tests::Mesh mesh = tests::random_soup(150, 0.5f, 303);
  const std::vector<Receiver> receivers = tests::random_receivers(40, 1, 304);
  const SamplePattern pattern = SamplePattern::standard(100).with_falloff(Falloff::smooth());
  const RayOptions options{.radius = 1.5f, .min_distance = 0.4f};
  const AmbientOcclusion ao(OccluderBvh(mesh.view()), pattern, options, GetParam().kernel);
  const bvh::RayParts parts = bvh::make_ray_parts(pattern.lengths(), options.radius, options.min_distance, kInfinity);
  int short_count = 0;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const OcclusionMask mask = ao.query(receivers[i], i).mask;
    ASSERT_EQ(mask, tests::brute_force_mask(mesh.view(), ao.rays(receivers[i], i), options, kNoPrimitive, &parts)) << i;
    for (int ray = 0; ray < pattern.ray_count(); ++ray) {
      if (pattern.lengths()[static_cast<std::size_t>(ray)] * options.radius > options.min_distance) continue;
      ASSERT_FALSE(mask.test(ray));
      ++short_count;
    }
  }
  EXPECT_GT(short_count, 100);
}

// Each level counts from there on, and one that has ended before not at all.
TEST_P(MinDistance, CutsEveryLevel) {
  const OccluderBvh a(tests::random_soup(300, 0.3f, 305).view()), b(tests::random_soup(300, 0.3f, 306).view());
  const std::vector<Receiver> receivers = tests::random_receivers(40, 1, 307);
  const SamplePattern& pattern = SamplePattern::standard(64);
  for (const float radius : {1.2f, kInfinity}) {
    const auto compare = [&](float min_distance, const std::vector<OccluderLevel>& same) {
      const AmbientOcclusion ao({{a, 0, 0.5f}, {b, 0.5f}}, pattern, {.radius = radius, .min_distance = min_distance},
                                GetParam().kernel);
      const AmbientOcclusion expected(same, pattern, {.radius = radius}, GetParam().kernel);
      int blocked_count = 0;
      for (std::size_t i = 0; i < receivers.size(); ++i) {
        ASSERT_EQ(ao.query(receivers[i], i).mask, expected.query(receivers[i], i).mask) << min_distance << ", " << i;
        blocked_count += ao.query(receivers[i], i).mask.count();
      }
      EXPECT_GT(blocked_count, 100);
    };
    compare(0.2f, {{a, 0.2f, 0.5f}, {b, 0.5f}});
    compare(0.5f, {{b, 0.5f}});
    compare(0.7f, {{b, 0.7f}});
  }
}

// Of a ceiling at height h, rays see the ring of heights between h / radius and h / min_distance.
TEST_P(MinDistance, LeavesARingOfACeiling) {
  tests::Mesh ceiling;
  tests::add_quad(ceiling, {-1000, 1, -1000}, {2000, 0, 0}, {0, 0, 2000});
  const AmbientOcclusion ao(OccluderBvh(ceiling.view()), SamplePattern::standard(1000),
                            {.radius = 2, .min_distance = 1.25f}, GetParam().kernel);
  EXPECT_NEAR(ao.query({.normal = {0, 1, 0}}, 0).occlusion, 0.64 - 0.25, 1.5e-3);
}

TEST(MinDistanceOfATable, EqualsTheExactKernels) {
  for (const auto& [count, size] : {std::pair(3, 2.0f), std::pair(300, 0.3f), std::pair(4000, 0.05f)}) {
    const OccluderBvh occluders(tests::random_soup(count, size, 308).view());
    const std::vector<Receiver> receivers = tests::random_receivers(40, 1, 309);
    for (const Falloff& falloff : {Falloff::constant(), Falloff::linear()}) {
      const SamplePattern pattern = SamplePattern::standard(100).with_falloff(falloff);
      const PlaneMaskTable table(pattern, {.resolution = 32});
      const PlaneMaskTable nearest(pattern, {.resolution = 64, .masks = PlaneMasks::nearest});
      for (const RayOptions& options :
           {RayOptions{.radius = 0.8f, .min_distance = 0.01f}, RayOptions{.radius = 0.8f, .min_distance = 0.4f},
            RayOptions{.radius = 8, .min_distance = 0.7f}}) {
        const AmbientOcclusion exact(occluders, pattern, options), by_table(occluders, table, options),
            by_nearest(occluders, nearest, options);
        int difference_count = 0, blocked_count = 0;
        for (std::size_t i = 0; i < receivers.size(); ++i) {
          const OcclusionMask mask = exact.query(receivers[i], i).mask, close = by_nearest.blocked(receivers[i], i);
          ASSERT_EQ(by_table.query(receivers[i], i).mask, mask) << options.min_distance << ", " << i;
          difference_count += (mask & ~close).count() + (close & ~mask).count();
          blocked_count += mask.count();
        }
        EXPECT_LT(difference_count, 20 + blocked_count / 2) << options.min_distance;
      }
    }
  }
}

TEST(MinDistanceOfRays, MustBeLessThanTheRadius) {
  const OccluderBvh occluders(tests::closed_box().view());
  for (const float bad :
       {-1.0f, 1.0f, 2.0f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    try {
      const AmbientOcclusion ao(occluders, SamplePattern::standard(64), {.radius = 1, .min_distance = bad});
      FAIL() << bad;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("min_distance must be at least 0, less than the radius"),
                std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace lkao
