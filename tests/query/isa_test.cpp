// Every SIMD target gives the bits of the scalar kernel.
#include "lkao/isa.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lkao/lkao.h"
#include "support/meshes.h"
#include "support/receivers.h"
#include "support/sanitized.h"

namespace lkao {
namespace {

class Isa : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { force_isa(GetParam()); }
  void TearDown() override { force_isa(""); }
};

INSTANTIATE_TEST_SUITE_P(All, Isa, testing::ValuesIn(available_isas()), [](const auto& isa) { return isa.param; });

TEST(IsaNames, ForcedOneIsActive) {
  const std::string best = active_isa();
  ASSERT_FALSE(available_isas().empty());
  for (const std::string& name : available_isas()) {
    force_isa(name);
    EXPECT_EQ(active_isa(), name);
  }
  force_isa("");
  EXPECT_EQ(active_isa(), best);
  EXPECT_THROW(force_isa("mmx"), std::invalid_argument);
}

TEST(IsaNames, ForcingOneLeavesOtherUsersOfHighwayAlone) {
  const std::int64_t before = hwy::SupportedTargets();
  force_isa(available_isas().back());
  EXPECT_EQ(hwy::SupportedTargets(), before);
  force_isa("");
}

struct Options {
  float radius;
  Sidedness sidedness;
  int ray_count;
};

void expect_scalar_bits(const tests::Mesh& mesh, const std::vector<Receiver>& receivers, const Options& options) {
  const OccluderBvh occluders(mesh.view());
  const SamplePattern pattern = SamplePattern::standard(options.ray_count).with_falloff(Falloff::linear());
  const RayOptions query{.radius = options.radius, .sidedness = options.sidedness};
  const AmbientOcclusion simd(occluders, pattern, query);
  const AmbientOcclusion scalar(occluders, pattern, query, Kernel::scalar);
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    ASSERT_EQ(simd.query(receivers[i], i).mask, scalar.query(receivers[i], i).mask) << "receiver " << i;
  }
}

TEST_P(Isa, EqualsTheScalarKernelInSoups) {
  constexpr int kReceiverCount = tests::unless_sanitized(12, 3);
  for (const auto& [count, size] :
       {std::pair(1, 2.0f), std::pair(20, 1.0f), std::pair(5000, 0.05f), std::pair(5000, 0.5f)}) {
    const tests::Mesh mesh = tests::random_soup(count, size, 101);
    for (int ray_count : {64, 192, 1024}) {
      for (float radius : {0.03f, 0.4f, 4.0f}) {
        for (Sidedness sidedness : {Sidedness::two_sided, Sidedness::one_sided}) {
          expect_scalar_bits(mesh, tests::with_exclusions(tests::random_receivers(kReceiverCount, 1, 102), 5),
                             {radius, sidedness, ray_count});
        }
      }
    }
  }
}

// Coordinates on a coarse grid: flat boxes, shared planes, receivers on faces, edges and corners, rays along axes.
TEST_P(Isa, EqualsTheScalarKernelOnAGrid) {
  lut::RandomStream random(103);
  tests::Mesh mesh = tests::random_soup(3000, 0.4f, 104);
  for (glm::vec3& p : mesh.positions) p = glm::round(p * 8.0f) / 8.0f;
  std::vector<Receiver> receivers =
      tests::with_exclusions(tests::random_receivers(tests::unless_sanitized(300, 60), 1, 105), 5);
  for (Receiver& receiver : receivers) {
    receiver.position = glm::round(receiver.position * 8.0f) / 8.0f;
    glm::vec3 axis(0);
    axis[static_cast<int>(random.next_below(3))] = random.next_below(2) == 0 ? 1.0f : -1.0f;
    receiver.normal = axis;
    receiver.geometric_normal = glm::vec3(0);
  }
  expect_scalar_bits(mesh, receivers, {0.6f, Sidedness::two_sided, 128});
}

// Slivers of all thicknesses, down to what single precision cannot tell from a line.
TEST_P(Isa, EqualsTheScalarKernelAmongSlivers) {
  lut::RandomStream random(106);
  tests::Mesh mesh;
  for (unsigned i = 0; i < 3000; ++i) {
    const glm::vec3 start = tests::random_point(random, 1), end = tests::random_point(random, 1);
    const float thickness = std::pow(10.0f, tests::uniform(random, -8, 0));
    mesh.positions.insert(mesh.positions.end(), {start, end, end + tests::random_direction(random) * thickness});
    mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  expect_scalar_bits(mesh, tests::with_exclusions(tests::random_receivers(tests::unless_sanitized(200, 40), 1, 107), 5),
                     {1.0f, Sidedness::two_sided, 256});
}

// Far from the origin, tiny and huge.
TEST_P(Isa, EqualsTheScalarKernelAtAnyScale) {
  for (float scale : {1e-12f, 1e-6f, 1e6f, 1e12f}) {
    for (float offset : {0.0f, 1e3f, 1e6f}) {
      tests::Mesh mesh = tests::random_soup(500, 0.3f, 108);
      for (glm::vec3& p : mesh.positions) p = (p + glm::vec3(offset, -offset, 0.5f * offset)) * scale;
      std::vector<Receiver> receivers = tests::with_exclusions(tests::random_receivers(20, 1, 109), 5);
      for (Receiver& receiver : receivers) {
        receiver.position = (receiver.position + glm::vec3(offset, -offset, 0.5f * offset)) * scale;
      }
      expect_scalar_bits(mesh, receivers, {0.7f * scale, Sidedness::two_sided, 128});
    }
  }
}

}  // namespace
}  // namespace lkao
