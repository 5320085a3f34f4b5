// Meshes with holes: the query against Embree with the same holes, and against each ray by itself with a sampler that
// shares nothing with the library's.
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bvh/ray_triangle.h"
#include "meshes.h"
#include "reference/embree_reference.h"
#include "scene/alpha_files.h"
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

// A card at z = 0 and receivers below: where a ray meets it is plain, and so is what a texture shows there.
TEST(HolesAgreement, APlainSamplerFindsTheSameBits) {
  constexpr TextureWrap kWraps[] = {TextureWrap::repeat, TextureWrap::mirror, TextureWrap::clamp};
  for (int i = 0; i < 6; ++i) {
    const scene::AlphaTexture texture = scene::random_texture(5, 3, {kWraps[i % 3], kWraps[(i + 1) % 3]}, i < 3);
    Mesh mesh{.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, .triangles = {{0, 1, 2}, {0, 2, 3}}};
    Holes holes{
        .materials = {{.cut_off = 0.45, .factor = 0.9, .texture = texture}}, .triangles = {}, .numbers = {0, 1}};
    for (const glm::uvec3& t : mesh.triangles) {
      HoleTriangle triangle;
      for (int k = 0; k < 3; ++k) triangle.uvs[static_cast<std::size_t>(k)] = 1.7f * glm::vec2(mesh.positions[t[k]]);
      holes.triangles.push_back(triangle);
    }
    mesh.holes = std::make_shared<const Holes>(std::move(holes));
    const AmbientOcclusion query = query_of(mesh);
    std::size_t blocked_count = 0, met_count = 0;
    for (std::uint64_t k = 0; k < 20; ++k) {
      const Receiver receiver{.position = {-0.5f + 0.05f * static_cast<float>(k), 0.1f, -0.2f}, .normal = {0, 0, 1}};
      const ReceiverRays rays = query.rays(receiver, k);
      const OcclusionMask blocked = query.blocked(receiver, k);
      for (int ray = 0; ray < rays.ray_count; ++ray) {
        const glm::dvec3 from(rays.origin), along(rays.ray(ray));
        const double share = -from.z / along.z;
        const glm::dvec2 hit = glm::dvec2(from) + share * glm::dvec2(along);
        const bool is_met = share <= 1 && std::abs(hit.x) < 1 && std::abs(hit.y) < 1;
        const bool is_there = is_met && 0.9 * scene::plain_alpha(texture, static_cast<double>(1.7f) * hit) >= 0.45;
        ASSERT_EQ(blocked.test(ray), is_there) << i << ": " << hit.x << ", " << hit.y;
        met_count += is_met ? 1 : 0;
        blocked_count += is_there ? 1 : 0;
      }
    }
    EXPECT_GT(blocked_count, met_count / 5);
    EXPECT_LT(blocked_count, 4 * met_count / 5);
  }
}

}  // namespace
}  // namespace lkao::reference
