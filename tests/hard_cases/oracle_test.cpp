// The oracle itself.
#include "oracle.h"

#include <cmath>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "distance.h"
#include "exact_sum.h"
#include "support/brute_force.h"
#include "support/meshes.h"

namespace lkao::tests {
namespace {

TEST(ExactSum, KeepsWhatDoublesLose) {
  const ExactSum large(1e30), small(1e-30), one(1);
  EXPECT_EQ((large + small - large).sign(), 1);
  EXPECT_EQ((large - small - large).sign(), -1);
  EXPECT_EQ((large + small - large - small).sign(), 0);
  // (2^40 + 2^-40)^2 - 2^80 - 2 - 2^-80 = 0.
  const ExactSum sum = ExactSum(0x1p40) + ExactSum(0x1p-40), rest = sum * sum - ExactSum(0x1p80) - ExactSum(2);
  EXPECT_EQ(rest.sign(), 1);
  EXPECT_EQ((rest - ExactSum(0x1p-80)).sign(), 0);
  EXPECT_EQ((one - one).sign(), 0);
  EXPECT_EQ(ExactSum().sign(), 0);
}

// The smallest and the largest floats.
TEST(ExactSum, NeitherUnderflowsNorOverflows) {
  const ExactSum tiny(0x1p-149), huge(0x1.fffffep127);
  EXPECT_EQ((tiny * tiny * tiny).sign(), 1);
  EXPECT_EQ((huge * huge * huge + tiny * tiny * tiny - huge * huge * huge).sign(), 1);
  EXPECT_EQ(((huge - tiny) * huge * huge - huge * huge * huge).sign(), -1);
}

const glm::vec3 kA(-1, -1, 2), kB(1, -1, 2), kC(0, 1, 2);

Crossing crossing(const glm::vec3& origin, const glm::vec3& ray) {
  return SeenTriangle(kA, kB, kC, origin).crossing(ray);
}

TEST(SeenTriangle, RayCrossesOrMisses) {
  EXPECT_EQ(crossing({0, 0, 0}, {0, 0, 3}), Crossing::inside);
  EXPECT_EQ(crossing({0, 0, 4}, {0, 0, -3}), Crossing::inside);
  EXPECT_EQ(crossing({0, 0, 0}, {0, 0, 1.9f}), Crossing::none);
  EXPECT_EQ(crossing({0, 0, 0}, {0, 0, -3}), Crossing::none);
  EXPECT_EQ(crossing({0.9f, 0.5f, 0}, {0, 0, 3}), Crossing::none);
  EXPECT_EQ(crossing({0, 0, 0}, {0, 0, 0}), Crossing::none);
}

// One step of a float decides.
TEST(SeenTriangle, TiesAreExact) {
  EXPECT_EQ(crossing({0, 0, 0}, {0, 0, 2}), Crossing::touching);
  EXPECT_EQ(crossing({0, 0, 0}, {0, 0, std::nextafter(2.0f, 0.0f)}), Crossing::none);
  EXPECT_EQ(crossing({0, 0, 0}, {0, 0, std::nextafter(2.0f, 3.0f)}), Crossing::inside);
  EXPECT_EQ(crossing({0, -1, 0}, {0, 0, 3}), Crossing::touching);
  EXPECT_EQ(crossing({0, std::nextafter(-1.0f, 0.0f), 0}, {0, 0, 3}), Crossing::inside);
  EXPECT_EQ(crossing({0, std::nextafter(-1.0f, -2.0f), 0}, {0, 0, 3}), Crossing::none);
  EXPECT_EQ(crossing({0, 1, 0}, {0, 0, 3}), Crossing::touching);
  EXPECT_EQ(crossing({0, 1, 0}, {0x1p-149f, 0, 3}), Crossing::none);
  EXPECT_EQ(crossing({0, 0, 0}, {0.5f, 0, 2}), Crossing::touching);
}

TEST(SeenTriangle, PlaneOfTheOriginIsNotMet) {
  EXPECT_EQ(SeenTriangle(kA, kB, kC, {5, 0, 2}).side(), 0);
  EXPECT_EQ(crossing({0, 0, 2}, {0, 0, 1}), Crossing::none);
  EXPECT_EQ(crossing({5, 0, 2}, {-9, 0, 0}), Crossing::none);
  EXPECT_EQ(SeenTriangle(kA, kB, kC, {0, 0, 4}).side(), -1);
  EXPECT_EQ(SeenTriangle(kA, kB, kC, {0, 0, std::nextafter(2.0f, 0.0f)}).side(), 1);
}

TEST(Oracle, ZeroAreaIsExact) {
  EXPECT_TRUE(has_exactly_zero_area({0, 0, 0}, {1, 1, 1}, {3, 3, 3}));
  EXPECT_TRUE(has_exactly_zero_area(kA, kB, kB));
  EXPECT_FALSE(has_exactly_zero_area({0, 0, 0}, {1, 1, 1}, {3, 3, std::nextafter(3.0f, 0.0f)}));
  EXPECT_FALSE(has_exactly_zero_area({1e6f, 0, 0}, {1, 0x1p-149f, 1}, {3, 0, 1e-30f}));
}

// Away from ties, where a textbook in long double is right.
TEST(Oracle, AgreesWithATextbook) {
  const Mesh mesh = random_soup(300, 0.5f, 1);
  for (Sidedness sidedness : {Sidedness::two_sided, Sidedness::one_sided}) {
    const Oracle oracle(mesh.view(), sidedness);
    const AmbientOcclusion ao(OccluderBvh(mesh.view()), SamplePattern::standard(128), {.radius = 0.7f});
    lut::RandomStream random(2);
    int blocked_count = 0;
    for (std::uint64_t k = 0; k < 30; ++k) {
      const ReceiverRays rays = ao.rays({.position = random_point(random, 1), .normal = random_direction(random)}, k);
      OcclusionMask expected;
      for (const glm::uvec3& t : mesh.triangles) {
        for (int i = 0; i < rays.ray_count; ++i) {
          if (textbook_blocks(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z], rays.origin, rays.ray(i),
                              sidedness)) {
            expected.set(i);
          }
        }
      }
      ASSERT_EQ(oracle.blocked(rays), expected & rays.cast);
      blocked_count += expected.count();
    }
    EXPECT_GT(blocked_count, 300);
  }
}

TEST(Oracle, MeasuresDistances) {
  const Mesh mesh{{kA, kB, kC}, {{0, 1, 2}}};
  const Oracle oracle(mesh.view(), Sidedness::two_sided);
  ReceiverRays rays;
  const auto cast = [&](const glm::vec3& origin, const glm::vec3& ray) {
    rays.origin = origin;
    rays.x[0] = ray.x, rays.y[0] = ray.y, rays.z[0] = ray.z;
    rays.cast.set(0);
    rays.ray_count = 64;
  };
  // Ends 1/4 before the plane, passes the edge in the plane y = -1 by 1/2; relative to a ray of length 4.
  cast({0, 0, -2}, {0, 0, 3.75f});
  EXPECT_DOUBLE_EQ(oracle.distance_from_blocked(rays, 0, kNoPrimitive), 0.25 / std::sqrt(18.0));
  cast({0, -1.5f, -2}, {0, 0, 8});
  EXPECT_DOUBLE_EQ(oracle.distance_from_blocked(rays, 0, kNoPrimitive), 0.5 / 8);
  cast({0, 0, 1.5f}, {0, 0, 8});
  EXPECT_DOUBLE_EQ(oracle.distance_from_plane(rays, 0, kNoPrimitive), 0.5 / 8);
  EXPECT_EQ(oracle.crossing_count(rays, 0), 1);
  cast({0, 1, 1.5f}, {0, 0, 8});
  EXPECT_EQ(oracle.crossing_count(rays, 0), -1);
}

TEST(Distance, OfSegments) {
  const RealVec o(0), x(1, 0, 0);
  EXPECT_EQ(segment_distance(o, x, {0.5, -1, 2}, {0.5, 1, 2}), 2);  // skew, inside both
  EXPECT_EQ(segment_distance(o, x, {0, 3, 0}, {1, 3, 0}), 3);       // parallel
  EXPECT_EQ(segment_distance(o, x, {4, 0, 0}, {5, 0, 0}), 3);       // on one line
  EXPECT_EQ(segment_distance(o, x, {4, 4, 0}, {9, 4, 0}), 5);       // from end to end
  EXPECT_EQ(segment_distance(o, o, {0, 2, 0}, {0, 2, 0}), 2);       // points
}

}  // namespace
}  // namespace lkao::tests
