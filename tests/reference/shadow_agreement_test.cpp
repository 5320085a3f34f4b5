// Soft shadows against Embree with the same rays.
#include <vector>

#include <gtest/gtest.h>

#include "meshes.h"
#include "reference/embree_reference.h"

namespace lkao::reference {
namespace {

void expect_agreement_under(const AreaLight& light, Sidedness sidedness) {
  const scene::Mesh mesh = random_soup(3000, 0.06f, 21);
  std::vector<Receiver> receivers = random_receivers(1000, 22);
  for (std::size_t k = 0; k < receivers.size(); k += 5) receivers[k].excluded_primitive = static_cast<std::uint32_t>(k);
  const SoftShadows shadows(OccluderBvh(mesh.view()), light, SamplePattern::standard(128), {.sidedness = sidedness});
  std::vector<std::uint64_t> masks(2 * receivers.size()), expected(2 * receivers.size());
  std::vector<float> visibility(receivers.size()), expected_visibility(receivers.size());
  const QueryReport report = shadows.query(receivers, {.visibility = visibility, .mask_words = masks});
  const EmbreeReference embree(mesh);
  const QueryReport same =
      embree.query(shadows, receivers, {.visibility = expected_visibility, .mask_words = expected});
  EXPECT_EQ(same.ray_count, report.ray_count);
  EXPECT_GT(report.blocked_ray_count, report.ray_count / 20);
  EXPECT_LT(report.blocked_ray_count, report.ray_count * 9 / 10);
  EXPECT_LE(count_mismatched_rays(masks, expected), report.ray_count / 100'000);
  for (std::size_t k = 0; k < receivers.size(); ++k) ASSERT_NEAR(visibility[k], expected_visibility[k], 0.01) << k;
}

TEST(ShadowAgreement, Discs) {
  for (const Sidedness sidedness : {Sidedness::two_sided, Sidedness::one_sided}) {
    expect_agreement_under(DiscLight{{0.3f, 1.5f, 0.2f}, {0, -1, 0.2f}, 0.4f}, sidedness);
  }
}

TEST(ShadowAgreement, Spheres) {
  expect_agreement_under(SphereLight{{0.3f, 1.5f, 0.2f}, 0.4f}, Sidedness::two_sided);
  expect_agreement_under(SphereLight{{0, 0, 0}, 0.9f}, Sidedness::one_sided);  // many receivers within
}

}  // namespace
}  // namespace lkao::reference
