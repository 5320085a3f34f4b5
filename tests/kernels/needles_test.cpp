// A needle for every ray: tiny triangles at random shares of the rays of one receiver, all at once and a few at a time.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "needles.h"
#include "ray_counts.h"
#include "same_bits.h"

namespace lkao::tests {
namespace {

struct Shares {
  float least, most;
};

class Needles : public testing::TestWithParam<int> {
 protected:
  SamplePattern pattern() const { return SamplePattern::standard(GetParam()); }

  // On every `step`th ray of the receiver with index 0. Of a size relative to their distance.
  Mesh needles_on_rays(const AmbientOcclusion& ao, const Receiver& receiver, const Shares& shares, int step,
                       float size) {
    const ReceiverRays rays = ao.rays(receiver, 0);
    Mesh mesh;
    for (int i = static_cast<int>(random_.next_below(static_cast<std::uint64_t>(step))); i < rays.ray_count;
         i += step) {
      const glm::vec3 ray = uniform(random_, shares.least, shares.most) * rays.ray(i);
      add_needles(mesh, rays.origin + ray, size * glm::length(ray), Touch::inside, random_);
    }
    return mesh;
  }

  // The receiver whose rays they are, and neighbours of it.
  std::vector<Receiver> receivers_around(const Receiver& receiver, float distance, int count) {
    std::vector<Receiver> receivers{receiver};
    for (int i = 0; i < count; ++i) {
      receivers.push_back({.position = receiver.position + random_point(random_, distance),
                           .normal = receiver.normal + 0.3f * random_direction(random_)});
    }
    return receivers;
  }

  lut::RandomStream random_{21};
};

INSTANTIATE_TEST_SUITE_P(Rays, Needles, ray_counts({64, 128, 192, 256, 960}), testing::PrintToStringParamName());

TEST_P(Needles, OnEveryRayAreFound) {
  for (const Shares& shares : {Shares{1e-3f, 1}, {0.9f, 1}, {0.05f, 0.06f}}) {
    for (const Sidedness sidedness : {Sidedness::two_sided, Sidedness::one_sided}) {
      const RayOptions options{.radius = 2.5f, .sidedness = sidedness};
      const AmbientOcclusion nothing(OccluderBvh(TriangleMesh{}), pattern(), options);
      for (const float away : {0.0f, 20.0f}) {
        const Receiver receiver{.position = away * random_direction(random_), .normal = random_direction(random_)};
        for (const float size : {1e-2f, 1e-4f}) {
          const Mesh mesh = needles_on_rays(nothing, receiver, shares, 1, size);
          const std::uint64_t blocked_count =
              expect_same_bits(mesh, pattern(), options, receivers_around(receiver, 0.1f, 4));
          EXPECT_GT(blocked_count, static_cast<std::uint64_t>(GetParam()) / 4);
        }
      }
    }
  }
}

// Few, so that the boxes of nodes hold little else: in batches, where entry nodes leave out what is out of reach.
TEST_P(Needles, OnFewRaysAreFound) {
  const SamplePattern uneven = pattern().with_falloff(Falloff::linear());
  for (int repetition = 0; repetition < 40; ++repetition) {
    const RayOptions options{.radius = std::exp2(uniform(random_, -6, 6)), .jitter = {.tilt = 0.1f}};
    const SamplePattern& asked = repetition % 2 == 0 ? uneven : pattern();
    const AmbientOcclusion nothing(OccluderBvh(TriangleMesh{}), asked, options);
    const Receiver receiver{.position = random_point(random_, 3), .normal = random_direction(random_)};
    const int step = GetParam() / (1 + repetition % 7);
    const Mesh mesh = needles_on_rays(nothing, receiver, {0.9f, 1}, step, 1e-4f);
    EXPECT_GT(expect_same_bits(mesh, asked, options, receivers_around(receiver, 0.02f * options.radius, 15)), 0u);
  }
}

// Each receiver has the rays of the first, and leaves out the needle on one of them.
TEST_P(Needles, ThatAreExcludedAreNot) {
  const RayOptions options{.radius = 1, .jitter = {.rotation = 0}};
  const AmbientOcclusion nothing(OccluderBvh(TriangleMesh{}), pattern(), options);
  const Receiver receiver{.normal = random_direction(random_)};
  Mesh mesh = needles_on_rays(nothing, receiver, {0.1f, 1}, 1, 1e-2f);
  const std::size_t needle_count = mesh.triangles.size() / 4;
  for (std::size_t i = 0; i < needle_count; ++i) mesh.triangles[i] = mesh.triangles[4 * i];
  mesh.triangles.resize(needle_count);
  std::vector<Receiver> receivers(40, receiver);
  for (Receiver& one : receivers) one.excluded_primitive = static_cast<std::uint32_t>(random_.next_below(needle_count));
  const std::uint64_t blocked_count = expect_same_bits(mesh, pattern(), options, receivers);
  EXPECT_LT(blocked_count, 40 * needle_count);
  EXPECT_GT(blocked_count, 20 * needle_count);
}

}  // namespace
}  // namespace lkao::tests
