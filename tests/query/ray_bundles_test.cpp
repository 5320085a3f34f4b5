// Any rays of a common origin: against every triangle one by one, in any order, of any lengths.
#include "lkao/ray_bundles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <glm/geometric.hpp>

#include "support/brute_force.h"
#include "support/kernel_choice.h"
#include "support/meshes.h"

namespace lkao {
namespace {

using Rays = std::vector<glm::vec3>;

// Within `spread` of a direction: all around where that is large. Lengths from half of `length` to all of it.
Rays random_rays(lut::RandomStream& random, int count, float spread, float length) {
  const glm::vec3 middle = tests::random_direction(random);
  Rays rays;
  rays.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const glm::vec3 direction = glm::normalize(middle + spread * tests::random_direction(random));
    rays.push_back(direction * (length * tests::uniform(random, 0.5f, 1)));
  }
  return rays;
}

float longest_of(const Rays& rays) {
  float longest = 0;
  for (const glm::vec3& ray : rays) longest = std::max(longest, glm::length(ray));
  return longest;
}

// Every ray against every triangle, by the definition.
OcclusionMask brute_force(const tests::Mesh& mesh, const glm::vec3& origin, const Rays& bundle, Sidedness sidedness,
                          std::uint32_t excluded_primitive = kNoPrimitive) {
  ReceiverRays rays;
  rays.origin = origin;
  rays.ray_count = static_cast<int>(bundle.size());
  rays.radius = longest_of(bundle);
  for (int i = 0; i < rays.ray_count; ++i) {
    const glm::vec3& ray = bundle[static_cast<std::size_t>(i)];
    rays.x[i] = ray.x;
    rays.y[i] = ray.y;
    rays.z[i] = ray.z;
    rays.cast.set(i);
  }
  return tests::brute_force_mask(mesh.view(), rays, {.radius = rays.radius, .sidedness = sidedness},
                                 excluded_primitive);
}

class RayBundlesBy : public tests::OnEveryKernel {
 protected:
  static RayBundles bundles_of(const tests::Mesh& mesh, Sidedness sidedness = Sidedness::two_sided) {
    return RayBundles(OccluderBvh(mesh.view()), sidedness, GetParam().kernel);
  }
};
INSTANTIATE_TEST_SUITE_P(Kernels, RayBundlesBy, testing::ValuesIn(tests::all_kernels()), tests::name_of_choice);

TEST_P(RayBundlesBy, EveryTriangleAlone) {
  lut::RandomStream random(201);
  int blocked_count = 0, open_count = 0;
  for (const Sidedness sidedness : {Sidedness::two_sided, Sidedness::one_sided}) {
    const tests::Mesh mesh = tests::random_soup(400, 0.2f, 202);
    const RayBundles bundles = bundles_of(mesh, sidedness);
    for (const int ray_count : {1, 15, 16, 17, 64, 65, 130, 1024}) {
      for (const float spread : {0.01f, 0.3f, 1.0f, 100.0f}) {
        const Rays rays = random_rays(random, ray_count, spread, 1.5f);
        const glm::vec3 origin = tests::random_point(random, 1);
        const auto excluded = static_cast<std::uint32_t>(random.next_below(400));
        const OcclusionMask blocked = bundles.blocked(origin, rays, excluded);
        ASSERT_EQ(blocked, brute_force(mesh, origin, rays, sidedness, excluded)) << ray_count << " in " << spread;
        blocked_count += blocked.count();
        open_count += ray_count - blocked.count();
      }
    }
  }
  EXPECT_GT(blocked_count, 500);
  EXPECT_GT(open_count, 500);
}

// Beside the edge of a triangle a millionth as large as the longest ray, within what rounding grants that one, and
// within the triangle's box.
TEST_P(RayBundlesBy, LongRaysDoNotWidenTrianglesForShortOnes) {
  constexpr float kSize = 1e-6f, kBeside = 1e-4f * kSize;
  tests::Mesh mesh;
  mesh.positions = {{-kSize, -kSize, kSize}, {kSize, -kSize, kSize}, {kSize, kSize, kSize}};
  mesh.triangles = {{0, 1, 2}};
  const RayBundles bundles = bundles_of(mesh);
  const Rays rays = {
      {-kBeside, kBeside, 1.5f * kSize}, {kBeside, -kBeside, 1.5f * kSize}, {-1e6f, 1, 2}, {0, 0, -1e3f}};
  const OcclusionMask blocked = bundles.blocked({}, rays);
  EXPECT_FALSE(blocked.test(0));
  EXPECT_TRUE(blocked.test(1));
  EXPECT_EQ(blocked.count(), 1);
}

// Rays of lengths from 1e-6 to 1e6 in one bundle are answered as each of them alone.
TEST_P(RayBundlesBy, LengthsMayBeFarApart) {
  lut::RandomStream random(203);
  tests::Mesh mesh = tests::random_soup(100, 0.3f, 204);
  for (const float size : {1e-6f, 1e-3f, 1e3f, 1e6f}) {
    const tests::Mesh part = tests::random_soup(100, 0.3f, 205);
    for (const glm::uvec3& t : part.triangles) {
      const auto first = static_cast<unsigned>(mesh.positions.size());
      for (int i = 0; i < 3; ++i) mesh.positions.push_back(part.positions[t[i]] * size);
      mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
  }
  const RayBundles bundles = bundles_of(mesh);
  Rays rays;
  rays.reserve(256);
  for (int i = 0; i < 256; ++i) {
    rays.push_back(tests::random_direction(random) * std::pow(10.0f, tests::uniform(random, -6, 6)));
  }
  const OcclusionMask blocked = bundles.blocked({}, rays);
  for (int i = 0; i < 256; ++i) {
    const Rays alone(1, rays[static_cast<std::size_t>(i)]);
    ASSERT_EQ(blocked.test(i), bundles.blocked({}, alone).test(0)) << i;
  }
  EXPECT_GT(blocked.count(), 10);
  EXPECT_LT(blocked.count(), 246);
}

TEST_P(RayBundlesBy, OrderIsOfNoAccount) {
  lut::RandomStream random(206);
  const RayBundles bundles = bundles_of(tests::random_soup(2000, 0.1f, 207));
  const Rays rays = random_rays(random, 512, 1, 1);
  std::vector<std::size_t> order(rays.size());
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t i = order.size() - 1; i > 0; --i) std::swap(order[i], order[random.next_below(i + 1)]);
  Rays shuffled;
  shuffled.reserve(rays.size());
  for (const std::size_t place : order) shuffled.push_back(rays[place]);
  const OcclusionMask blocked = bundles.blocked({}, rays), of_shuffled = bundles.blocked({}, shuffled);
  EXPECT_GT(blocked.count(), 50);
  for (std::size_t i = 0; i < order.size(); ++i) {
    ASSERT_EQ(of_shuffled.test(static_cast<int>(i)), blocked.test(static_cast<int>(order[i])));
  }
}

// A ray holds its end and not its beginning.
TEST_P(RayBundlesBy, SegmentsAreOpenAtTheOriginAndClosedAtTheEnd) {
  tests::Mesh mesh;
  tests::add_quad(mesh, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  tests::add_quad(mesh, {-1, -1, 1}, {2, 0, 0}, {0, 2, 0});
  const RayBundles bundles = bundles_of(mesh);
  const float below = std::nextafter(1.0f, 0.0f);
  const Rays rays = {{0.1f, 0.2f, 1}, {0.1f, 0.2f, below}, {0.1f, 0.2f, -1}, {0.5f, 0, 0}, {0, 0, 0}};
  const OcclusionMask blocked = bundles.blocked({0.1f, 0, 0}, rays);
  EXPECT_EQ(blocked.words[0], 1u);
}

// Smallest and largest numbers that rays may have.
TEST_P(RayBundlesBy, LengthsAtTheEndsOfTheRange) {
  for (const float size : {1e-37f, 1e-20f, 1e10f, 3e17f}) {
    tests::Mesh mesh;
    tests::add_quad(mesh, glm::vec3(-1, -1, 1) * size, glm::vec3(2, 0, 0) * size, glm::vec3(0, 2, 0) * size);
    const RayBundles bundles = bundles_of(mesh);
    const Rays rays = {glm::vec3(0.1f, 0.2f, 1.5f) * size, glm::vec3(0.1f, 0.2f, 0.9f) * size,
                       glm::vec3(1.6f, 0, 1.5f) * size};
    // What is smaller than the margin of boxes may have no area left; then nothing is blocked.
    const bool is_there = bundles.occluders().occluder_count() > 0;
    EXPECT_EQ(bundles.blocked({}, rays).words[0], is_there ? 1u : 0u) << size;
    EXPECT_TRUE(is_there || size < 1e-30f) << size;
  }
}

TEST(RayBundles, ABatchIsItsBundlesOnAnyNumberOfThreads) {
  const RayBundles bundles(OccluderBvh(tests::random_soup(3000, 0.1f, 208).view()));
  lut::RandomStream random(209);
  std::vector<Rays> rays;
  std::vector<RayBundle> batch;
  rays.reserve(300);
  batch.reserve(300);
  for (int k = 0; k < 300; ++k) {
    rays.push_back(random_rays(random, 1 + k % 200, 0.5f, 1));
    batch.push_back({tests::random_point(random, 1), rays.back()});
  }
  for (const int thread_count : {1, 2, 5}) {
    const tbb::global_control workers(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(thread_count));
    std::vector<OcclusionMask> masks(batch.size());
    tbb::task_arena(thread_count).execute([&] { bundles.blocked(batch, masks); });
    int blocked_count = 0;
    for (std::size_t k = 0; k < batch.size(); ++k) {
      ASSERT_EQ(masks[k], bundles.blocked(batch[k].origin, batch[k].rays)) << k;
      blocked_count += masks[k].count();
    }
    EXPECT_GT(blocked_count, 1000);
  }
}

TEST(RayBundles, ABatchCanBeStopped) {
  const RayBundles bundles(OccluderBvh(tests::closed_box().view()));
  const Rays rays(3, {0, 0, 2});
  const std::vector<RayBundle> batch(1000, {.rays = rays});
  std::vector<OcclusionMask> masks(batch.size());
  EXPECT_THROW(bundles.blocked(batch, masks, [](std::size_t, std::size_t) { return false; }), Cancelled);
}

TEST(RayBundles, NameBadArguments) {
  const RayBundles bundles(OccluderBvh(tests::closed_box().view()));
  const auto error_of = [&](const glm::vec3& origin, const Rays& rays) -> std::string {
    try {
      bundles.blocked(origin, rays);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Rays good = {{0, 0, 1}};
  EXPECT_EQ(error_of({}, good), "");
  EXPECT_EQ(error_of({}, {}), "rays must be from 1 to 1024, not 0");
  EXPECT_EQ(error_of({}, Rays(1025, {0, 0, 1})), "rays must be from 1 to 1024, not 1025");
  EXPECT_EQ(error_of({0, nan, 0}, good), "origin must be within 1e18, not (0, nan, 0)");
  EXPECT_EQ(error_of({}, {{0, 0, 1}, {0, INFINITY, 1}}), "rays[1] must be within 5e17, not (0, inf, 1)");
  EXPECT_EQ(error_of({}, {{6e17f, 0, 1}}), "rays[0] must be within 5e17, not (6e+17, 0, 1)");
  std::vector<OcclusionMask> masks(2);
  EXPECT_THROW(bundles.blocked(std::vector<RayBundle>(3, {.rays = good}), masks), std::invalid_argument);
}

// Rays of a bundle are drawn by its index where triangles are thinned.
TEST_P(RayBundlesBy, ThinTrianglesWithHolesByTheirIndex) {
  tests::Mesh wall;
  tests::add_quad(wall, {-10, -10, 1}, {20, 0, 0}, {0, 20, 0});
  const RayBundles bundles(OccluderBvh(wall.view(), {.cut_outs = {.opacities = {0.25f, 0.25f}}}), Sidedness::two_sided,
                           GetParam().kernel);
  const std::vector<glm::vec3> rays(64, {0.1f, 0.2f, 2});
  std::vector<RayBundle> many(200);
  for (std::size_t k = 0; k < many.size(); ++k) many[k] = {.origin = {0, 0, 0}, .rays = rays, .index = k};
  std::vector<OcclusionMask> masks(many.size());
  bundles.blocked(many, masks);
  int count = 0;
  for (const OcclusionMask& mask : masks) count += mask.count();
  EXPECT_NEAR(count / (64.0 * 200), 0.25, 0.02);
  EXPECT_NE(masks[0], masks[1]);
  EXPECT_EQ(masks[0], bundles.blocked({0, 0, 0}, rays));
}

}  // namespace
}  // namespace lkao
