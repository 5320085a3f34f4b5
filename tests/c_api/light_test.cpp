// Bundles, soft shadows and the sky through C give the bits of those through C++.
#include <cstring>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/gtc/type_ptr.hpp>

#include "c_api/owned.h"
#include "lkao/c.h"
#include "lkao/lkao.h"
#include "support/meshes.h"
#include "support/receivers.h"

namespace lkao {
namespace {

using namespace tests;  // NOLINT(google-build-using-namespace)

using OwnedBundles = Owned<lkao_bundles, lkao_bundles_destroy>;
using OwnedShadows = Owned<lkao_shadows, lkao_shadows_destroy>;
using OwnedSky = Owned<lkao_sky, lkao_sky_destroy>;

lkao_receivers c_receivers(const std::vector<Receiver>& receivers) {
  lkao_receivers all = LKAO_RECEIVERS_INIT;
  all.count = receivers.size();
  all.positions = &receivers[0].position.x, all.position_stride = sizeof(Receiver);
  all.normals = &receivers[0].normal.x, all.normal_stride = sizeof(Receiver);
  all.geometric_normals = &receivers[0].geometric_normal.x, all.geometric_normal_stride = sizeof(Receiver);
  return all;
}

class CLight : public testing::Test {
 protected:
  Mesh mesh_ = random_soup(500, 0.1f, 3);
  OwnedScene scene_ = c_scene(mesh_);
  OccluderBvh occluders_{mesh_.view()};
  std::vector<Receiver> receivers_ = random_receivers(60, 1, 11);
  lkao_receivers all_ = c_receivers(receivers_);
  lkao_query_report report_ = LKAO_QUERY_REPORT_INIT;
};

TEST_F(CLight, BundlesAreThoseOfCpp) {
  lut::RandomStream random(5);
  std::vector<glm::vec4> rays(70);
  std::vector<glm::vec3> packed(70);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    packed[i] = random_direction(random);
    rays[i] = glm::vec4(packed[i], 7);
  }
  const OwnedBundles bundles =
      made<OwnedBundles>(lkao_bundles_create, scene_.get(), lkao_sidedness{LKAO_ONE_SIDED}, lkao_kernel{LKAO_SIMD});
  const RayBundles expected(occluders_, Sidedness::one_sided);
  std::vector<lkao_bundle> batch(10, LKAO_BUNDLE_INIT);
  for (std::size_t k = 0; k < batch.size(); ++k) {
    batch[k].rays = k % 2 == 0 ? &rays[0].x : &packed[0].x;
    batch[k].ray_stride = k % 2 == 0 ? sizeof(rays[0]) : 0, batch[k].ray_count = 70;
    std::memcpy(batch[k].origin, &receivers_[k].position, sizeof(batch[k].origin));
    batch[k].excluded_primitive = static_cast<std::uint32_t>(k);
  }
  std::vector<std::uint64_t> masks(30, 7);
  ASSERT_EQ(lkao_bundles_blocked_batch(bundles.get(), batch.data(), 10, masks.data(), 24, 2, nullptr), LKAO_OK)
      << lkao_last_error();
  int blocked_count = 0;
  for (std::size_t k = 0; k < batch.size(); ++k) {
    const OcclusionMask right = expected.blocked(receivers_[k].position, packed, static_cast<std::uint32_t>(k));
    blocked_count += right.count();
    EXPECT_TRUE(std::equal(right.words, right.words + 2, &masks[3 * k]));
    EXPECT_EQ(masks[3 * k + 2], 7u);
    std::uint64_t mask[3] = {7, 7, 7};
    ASSERT_EQ(lkao_bundles_blocked(bundles.get(), &batch[k], mask, 3), LKAO_OK);
    EXPECT_TRUE(std::equal(right.words, right.words + 3, mask));
  }
  EXPECT_GT(blocked_count, 20);
  std::uint64_t mask = 7;
  EXPECT_EQ(lkao_bundles_blocked(bundles.get(), &batch[0], &mask, 1), LKAO_ERROR_INVALID_ARGUMENT);
  EXPECT_STREQ(lkao_last_error(), "lkao_bundles_blocked: word_count must be at least 2 for bundle, not 1");
  batch[3].ray_count = 0;
  EXPECT_NE(lkao_bundles_blocked_batch(bundles.get(), batch.data(), 10, masks.data(), 24, 2, nullptr), LKAO_OK);
  EXPECT_STREQ(lkao_last_error(), "lkao_bundles_blocked_batch: bundles[3]->ray_count must be 1 to 1024, not 0");
  lkao_bounds bounds;
  EXPECT_EQ(lkao_scene_get_bounds(made<OwnedScene>(lkao_scene_create_of_bundles, bundles.get()).get(), &bounds),
            LKAO_OK);
}

TEST_F(CLight, SoftShadowsAreThoseOfCpp) {
  lkao_light light = LKAO_LIGHT_INIT;
  light.position[1] = 3, light.normal[1] = -2, light.radius = 0.5f;
  lkao_shadow_options options = LKAO_SHADOW_OPTIONS_INIT;
  options.sidedness = LKAO_ONE_SIDED, options.rotation = 0.5f, options.seed = 9, options.surface_offset = 3;
  const ShadowOptions cpp_options{.sidedness = Sidedness::one_sided, .rotation = 0.5f, .seed = 9, .surface_offset = 3};
  const OwnedPattern pattern = c_pattern(70);
  for (const lkao_light_kind kind : {LKAO_LIGHT_DISC, LKAO_LIGHT_SPHERE}) {
    light.kind = kind;
    const AreaLight cpp_light = kind == LKAO_LIGHT_DISC ? AreaLight(DiscLight{{0, 3, 0}, {0, -2, 0}, 0.5f})
                                                        : AreaLight(SphereLight{{0, 3, 0}, 0.5f});
    const OwnedShadows shadows = made<OwnedShadows>(lkao_shadows_create, scene_.get(), &light, pattern.get(), &options);
    const SoftShadows expected(occluders_, cpp_light, SamplePattern::standard(70), cpp_options);
    std::vector<float> visibility(60), above_horizon(60);
    std::vector<std::uint64_t> masks(120);
    lkao_shadow_outputs outputs = LKAO_SHADOW_OUTPUTS_INIT;
    outputs.visibility = visibility.data(), outputs.above_horizon = above_horizon.data(), outputs.masks = masks.data();
    ASSERT_EQ(lkao_shadows_query_batch(shadows.get(), &all_, &outputs, nullptr, &report_), LKAO_OK);
    EXPECT_GT(report_.blocked_ray_count, 20u);
    for (std::size_t i = 0; i < receivers_.size(); ++i) {
      const LightVisibility right = expected.query(receivers_[i], i);
      EXPECT_EQ(visibility[i], right.visibility);
      EXPECT_EQ(above_horizon[i], right.above_horizon);
      EXPECT_TRUE(std::equal(right.blocked.words, right.blocked.words + 2, &masks[2 * i]));
      const lkao_receiver receiver = c_receiver(receivers_[i]);
      lkao_visibility one = LKAO_VISIBILITY_INIT;
      ASSERT_EQ(lkao_shadows_query(shadows.get(), &receiver, i, &one), LKAO_OK);
      EXPECT_EQ(one.visibility, right.visibility);
      EXPECT_EQ(one.above_horizon, right.above_horizon);
      EXPECT_EQ(std::memcmp(one.mask, right.blocked.words, sizeof(one.mask)), 0);
      lkao_rays rays = LKAO_RAYS_INIT;
      float segments[70][3];
      ASSERT_EQ(lkao_shadows_get_rays(shadows.get(), &receiver, i, &rays, segments[0], 0), LKAO_OK);
      EXPECT_EQ(std::memcmp(segments[69], glm::value_ptr(expected.rays(receivers_[i], i).ray(69)), 12), 0);
    }
    lkao_light back = LKAO_LIGHT_INIT;
    ASSERT_EQ(lkao_shadows_get_light(shadows.get(), &back), LKAO_OK);
    EXPECT_EQ(back.kind, kind);
    EXPECT_EQ(back.position[1], 3);
    EXPECT_EQ(back.radius, 0.5f);
    EXPECT_EQ(back.normal[1], kind == LKAO_LIGHT_DISC ? -2 : 0);
    lkao_shadow_options options_back = LKAO_SHADOW_OPTIONS_INIT;
    ASSERT_EQ(lkao_shadows_get_options(shadows.get(), &options_back), LKAO_OK);
    EXPECT_EQ(std::memcmp(&options_back, &options, sizeof(options)), 0);
    EXPECT_EQ(lkao_pattern_ray_count(made<OwnedPattern>(lkao_pattern_create_of_shadows, shadows.get()).get()), 70);
  }
  lkao_shadows* shadows = nullptr;
  light.kind = 2;
  EXPECT_EQ(lkao_shadows_create(scene_.get(), &light, pattern.get(), nullptr, &shadows), LKAO_ERROR_INVALID_ARGUMENT);
  EXPECT_STREQ(lkao_last_error(), "lkao_shadows_create: light->kind must be 0 to 1, not 2");
  light.kind = LKAO_LIGHT_DISC, light.radius = 0;
  EXPECT_EQ(lkao_shadows_create(scene_.get(), &light, pattern.get(), nullptr, &shadows), LKAO_ERROR_INVALID_ARGUMENT);
}

TEST_F(CLight, TheSkyIsThatOfCpp) {
  lkao_sky_options options = LKAO_SKY_OPTIONS_INIT;
  options.ray_count = 128, options.seed = 5;
  for (const float radius : {0.0f, 0.4f}) {
    options.radius = radius;
    const OwnedSky sky = made<OwnedSky>(lkao_sky_create, scene_.get(), &options);
    const SkyVisibility expected(occluders_, 128,
                                 {.radius = radius == 0 ? std::numeric_limits<float>::infinity() : radius, .seed = 5});
    std::vector<lkao_sky_shares> shares(60);
    struct {
      std::size_t done = 0, total = 0;
    } seen;
    lkao_batch_options batch = LKAO_BATCH_OPTIONS_INIT;
    batch.progress_user = &seen;
    batch.progress = [](void* user, std::size_t done, std::size_t total) {
      *static_cast<decltype(seen)*>(user) = {done, total};
      return 1;
    };
    ASSERT_EQ(lkao_sky_query_batch(sky.get(), &all_, shares.data(), 0, &batch, &report_), LKAO_OK);
    EXPECT_EQ(seen.done, seen.total);
    for (std::size_t i = 0; i < receivers_.size(); ++i) {
      const SkyShares right = expected.query(receivers_[i], i);
      const lkao_receiver receiver = c_receiver(receivers_[i]);
      lkao_sky_shares one;
      ASSERT_EQ(lkao_sky_query(sky.get(), &receiver, i, &one), LKAO_OK);
      for (const lkao_sky_shares& actual : {one, shares[i]}) {
        EXPECT_EQ(actual.visibility, right.visibility);
        EXPECT_EQ(actual.above, right.above);
        EXPECT_EQ(actual.below, right.below);
      }
      EXPECT_LT(one.visibility, 1.1f);
    }
    EXPECT_GT(report_.blocked_ray_count, 20u);
  }
}

}  // namespace
}  // namespace lkao
