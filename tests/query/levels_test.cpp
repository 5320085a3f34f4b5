// Levels of detail: occluders that own a range of distances.
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bvh/ray_parts.h"
#include "bvh/ray_triangle.h"
#include "lkao/lkao.h"
#include "support/kernel_choice.h"
#include "support/meshes.h"
#include "support/receivers.h"
#include "support/sanitized.h"

namespace lkao::levels_test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Range {
  float r_min, r_max;
};
const std::vector<Range> kRanges = {{0, 0.1f}, {0.1f, 0.3f}, {0.3f, 0.31f}, {0.31f, 1.7f}, {1.7f, kInfinity}};

class Levels : public tests::OnEveryKernel {
 protected:
  RayOptions options(float radius, Sidedness sidedness = Sidedness::two_sided) const {
    return {.radius = radius, .sidedness = sidedness};
  }
};

INSTANTIATE_TEST_SUITE_P(Kernels, Levels, testing::ValuesIn(tests::all_kernels()), tests::name_of_choice);

// Neither a seam nor a double count where one range ends and the next begins.
TEST_P(Levels, OfTheSameOccludersGiveTheBitsOfNone) {
  for (const auto& [count, size] : {std::pair(3, 2.0f), std::pair(300, 0.3f), std::pair(4000, 0.05f)}) {
    const OccluderBvh occluders(tests::random_soup(count, size, 31).view());
    std::vector<OccluderLevel> levels;
    for (const Range& range : kRanges) levels.push_back({occluders, range.r_min, range.r_max});
    // None excludes a primitive: that is one of the first level only.
    const std::vector<Receiver> receivers = tests::random_receivers(tests::unless_sanitized(40, 5), 1, 32);
    for (const int ray_count : {64, 1024}) {
      for (const Falloff& falloff : {Falloff::constant(), Falloff::linear()}) {
        const SamplePattern pattern = SamplePattern::standard(ray_count).with_falloff(falloff);
        for (const float radius : {0.05f, 0.3f, 0.8f, 5.0f}) {
          const AmbientOcclusion whole(occluders, pattern, options(radius), GetParam().kernel),
              parts(levels, pattern, options(radius), GetParam().kernel);
          for (std::size_t i = 0; i < receivers.size(); ++i) {
            ASSERT_EQ(parts.query(receivers[i], i).mask, whole.query(receivers[i], i).mask)
                << ray_count << " rays, " << falloff.name() << ", radius " << radius << ", receiver " << i;
          }
        }
      }
    }
  }
}

// The part of a ray in each range, against every triangle of that range's own occluders.
OcclusionMask brute_force(const std::vector<tests::Mesh>& meshes, const SamplePattern& pattern,
                          const ReceiverRays& rays, const RayOptions& options, std::uint32_t excluded_primitive) {
  OcclusionMask blocked;
  for (std::size_t level = 0; level < meshes.size(); ++level) {
    const auto parts =
        bvh::make_ray_parts(pattern.lengths(), options.radius, kRanges[level].r_min, kRanges[level].r_max);
    for (std::uint32_t i = 0; i < meshes[level].triangles.size(); ++i) {
      if (level == 0 && i == excluded_primitive) continue;
      const glm::uvec3& t = meshes[level].triangles[i];
      const std::vector<glm::vec3>& p = meshes[level].positions;
      const bvh::TriangleTest test(p[t.x], p[t.y], p[t.z], rays.origin, options.radius, options.sidedness);
      if (!test.can_block()) continue;
      for (int ray = 0; ray < rays.ray_count; ++ray) {
        if (rays.cast.test(ray) && parts.existing.test(ray) &&
            test.blocks(rays.ray(ray), parts.begin[ray], parts.end[ray])) {
          blocked.set(ray);
        }
      }
    }
  }
  return blocked;
}

TEST_P(Levels, AreTheBruteForceOverEachRange) {
  std::vector<tests::Mesh> meshes;
  std::vector<OccluderLevel> levels;
  for (std::size_t i = 0; i < kRanges.size(); ++i) {
    meshes.push_back(tests::random_soup(400 >> i, 0.1f * static_cast<float>(1 << i), 41 + i));
    levels.push_back({OccluderBvh(meshes.back().view()), kRanges[i].r_min, kRanges[i].r_max});
  }
  const std::vector<Receiver> receivers =
      tests::with_exclusions(tests::random_receivers(tests::unless_sanitized(50, 10), 1, 42), 4);
  for (const Sidedness sidedness : {Sidedness::two_sided, Sidedness::one_sided}) {
    for (const Falloff& falloff : {Falloff::constant(), Falloff::linear()}) {
      const SamplePattern pattern = SamplePattern::standard(256).with_falloff(falloff);
      for (const float radius : {0.2f, 2.5f}) {
        const AmbientOcclusion ao(levels, pattern, options(radius, sidedness), GetParam().kernel);
        std::vector<std::uint64_t> batch(receivers.size() * 4);
        ao.query(receivers, {.mask_words = batch});
        for (std::size_t i = 0; i < receivers.size(); ++i) {
          const OcclusionMask expected =
              brute_force(meshes, pattern, ao.rays(receivers[i], i), ao.options(), receivers[i].excluded_primitive);
          ASSERT_EQ(ao.query(receivers[i], i).mask, expected) << falloff.name() << radius << ", receiver " << i;
          for (std::size_t word = 0; word < 4; ++word) ASSERT_EQ(batch[4 * i + word], expected.words[word]);
        }
      }
    }
  }
}

// A ceiling at height h blocks the share 1 - (h / r)^2 within the distance r.
TEST_P(Levels, OfACeilingBlockWhatIsKnown) {
  tests::Mesh mesh;
  tests::add_quad(mesh, {-100, -100, 1}, {200, 0, 0}, {0, 200, 0});
  const OccluderBvh ceiling(mesh.view());
  const auto within = [](float r) { return r > 1 ? 1 - 1 / (r * r) : 0.0f; };
  for (const Range& range : {Range{0, 1.5f}, {1.5f, 2}, {1.2f, 50}, {0.2f, 0.9f}, {2.5f, kInfinity}}) {
    const AmbientOcclusion ao({{ceiling, range.r_min, range.r_max}}, SamplePattern::standard(1024), options(3),
                              GetParam().kernel);
    const float expected = within(std::min(range.r_max, 3.0f)) - within(range.r_min);
    EXPECT_NEAR(ao.query({.normal = {0, 0, 1}}, 0).occlusion, expected, 0.004f) << range.r_min << " " << range.r_max;
  }
}

TEST(LevelRanges, AreRefusedWhereTheyAreNone) {
  const OccluderBvh occluders(tests::closed_box().view());
  const SamplePattern& pattern = SamplePattern::standard(64);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(AmbientOcclusion(std::vector<OccluderLevel>{}, pattern, {.radius = 1}), std::invalid_argument);
  for (const Range& range : {Range{1, 1}, {2, 1}, {-1, 1}, {nan, 1}, {0, nan}, {kInfinity, kInfinity}}) {
    EXPECT_THROW(AmbientOcclusion({{occluders, range.r_min, range.r_max}}, pattern, {.radius = 1}),
                 std::invalid_argument)
        << range.r_min << " " << range.r_max;
  }
}

// A level that begins behind the longest ray costs and changes nothing.
TEST(LevelRanges, BehindAllRaysBlockNothing) {
  const OccluderBvh box(tests::closed_box().view());
  const SamplePattern& pattern = SamplePattern::standard(64);
  const AmbientOcclusion ao({{box, 5, 6}, {box, 7, 8}}, pattern, {.radius = 4});
  EXPECT_EQ(ao.query({.normal = {0, 0, 1}}, 0).occlusion, 0);
}

}  // namespace
}  // namespace lkao::levels_test
