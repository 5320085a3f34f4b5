// Meshes with holes: the query against Embree with the same holes, and against each ray by itself with a sampler that
// shares nothing with the library's.
#include <vector>

#include <gtest/gtest.h>

#include "meshes.h"
#include "reference/embree_reference.h"
#include "scene/holes.h"
#include "support/brute_force.h"
#include "support/sanitized.h"

namespace lkao::reference {
namespace {

using scene::HoleMaterial, scene::Holes, scene::HoleTriangle, scene::Mesh, scene::TextureWrap;

constexpr int kRayCount = 128;

// Every second triangle of a soup has holes by one of three materials: mask, half-transparent, and mask that is smooth.
Mesh soup_with_holes() {
  Mesh mesh = random_soup(tests::unless_sanitized(1000, 100), 0.3f, 21);
  Holes holes;
  const auto checks = std::make_shared<const scene::AlphaImage>(scene::AlphaImage{2, 2, {0, 65535, 40000, 20000}});
  holes.materials = {
      HoleMaterial{.cut_off = 0.5, .factor = 1, .texture = scene::AlphaTexture{checks, {}, false}},
      HoleMaterial{.factor = 0.6, .texture = scene::AlphaTexture{checks, {}, true}},
      HoleMaterial{.cut_off = 0.3,
                   .factor = 1,
                   .texture = scene::AlphaTexture{checks, {TextureWrap::mirror, TextureWrap::clamp}, true}}};
  RandomPoints random(22);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    holes.numbers.push_back(t % 2 == 0 ? scene::kWhole : static_cast<std::uint32_t>(holes.triangles.size()));
    if (t % 2 == 0) continue;
    HoleTriangle triangle{.material = static_cast<std::uint32_t>(t / 2 % 3)};
    for (glm::vec2& uv : triangle.uvs) uv = 3.0f * glm::vec2(random.point());
    holes.triangles.push_back(triangle);
  }
  mesh.holes = std::make_shared<const Holes>(std::move(holes));
  return mesh;
}

AmbientOcclusion query_of(const Mesh& mesh, Kernel kernel = Kernel::simd) {
  return {OccluderBvh(mesh.view(), {.cut_outs = scene::cut_outs_of(mesh.holes)}),
          SamplePattern::standard(kRayCount),
          {.radius = 0.7f},
          kernel};
}

TEST(HolesAgreement, EmbreeFindsTheSameBits) {
  const Mesh mesh = soup_with_holes();
  const AmbientOcclusion query = query_of(mesh);
  Mesh whole = mesh;
  whole.holes = nullptr;
  const std::vector<Receiver> receivers = random_receivers(tests::unless_sanitized(2000, 100), 23);
  std::vector<std::uint64_t> words(receivers.size() * kRayCount / 64), of_embree(words.size()), of_whole(words.size());
  query.query(receivers, {.mask_words = words});
  for (const Casting casting : {Casting::packets, Casting::single_rays}) {
    EmbreeReference(mesh, {.casting = casting}).query(query, receivers, {.mask_words = of_embree});
    EXPECT_LE(count_mismatched_rays(words, of_embree), receivers.size() * kRayCount / 100000);
  }
  EmbreeReference(whole).query(query, receivers, {.mask_words = of_whole});
  EXPECT_GT(count_mismatched_rays(words, of_whole), receivers.size());
}

TEST(HolesAgreement, EveryRayAgainstEveryTriangleFindsTheSameBits) {
  const Mesh mesh = soup_with_holes();
  const AmbientOcclusion query = query_of(mesh), scalar = query_of(mesh, Kernel::scalar);
  const std::vector<Receiver> receivers = random_receivers(tests::unless_sanitized(200, 20), 24);
  std::size_t passed_count = 0;
  for (std::size_t k = 0; k < receivers.size(); ++k) {
    const ReceiverRays rays = query.rays(receivers[k], k);
    OcclusionMask expected;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const glm::uvec3& c = mesh.triangles[t];
      const bvh::TriangleTest test(mesh.positions[c.x], mesh.positions[c.y], mesh.positions[c.z], rays.origin,
                                   rays.radius, Sidedness::two_sided);
      for (int i = 0; test.can_block() && i < rays.ray_count; ++i) {
        if (!rays.cast.test(i) || !test.blocks(rays.ray(i))) continue;
        const bool is_blocked = mesh.holes->blocks(t, glm::vec2(test.place(rays.ray(i))));
        if (is_blocked) expected.set(i);
        passed_count += is_blocked ? 0 : 1;
      }
    }
    ASSERT_EQ(query.blocked(receivers[k], k), expected) << k;
    ASSERT_EQ(scalar.blocked(receivers[k], k), expected) << k;
  }
  EXPECT_GT(passed_count, receivers.size());
}

}  // namespace
}  // namespace lkao::reference
