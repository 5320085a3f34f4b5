// The smallest slivers that go wrong where rounding is bounded by the lengths of edges and not by the area.
#include <gtest/gtest.h>

#include "lkao/lkao.h"
#include "support/meshes.h"

namespace lkao::tests {
namespace {

constexpr float kWidth = 1e-7f;

// Where all coordinates are this small or simple, floats hold every position, and all distances are far above the
// rounding of double precision.
OcclusionMask query(const Mesh& mesh, const glm::vec3& position, const glm::vec3& normal, Kernel kernel) {
  const RayOptions options{.radius = 1, .surface_offset = 0};
  const AmbientOcclusion ao(OccluderBvh(mesh.view()), SamplePattern::standard(64), options, kernel);
  return ao.query({.position = position, .normal = normal}, 0).mask;
}

TEST(Slivers, BlockRaysFromJustBelow) {
  const Mesh sliver{{{0, 0, 0}, {1, 0, 0}, {0.5f, kWidth, 0}}, {{0, 1, 2}}};
  for (Kernel kernel : {Kernel::simd, Kernel::scalar}) {
    for (float height : {1e-11f, 1e-10f, 1e-9f}) {
      EXPECT_GT(query(sliver, {0.5f, 0.3f * kWidth, -height}, {0, 0, 1}, kernel).count(), 60) << height;
    }
  }
}

// The slanted side of a prism along the x axis, all of its faces slivers: the receiver is inside, a hundredth of the
// width below it.
TEST(Slivers, ClosedOnesDoNotLeak) {
  const Mesh prism{{{-1, 0, 0}, {-1, kWidth, 0}, {-1, 0, kWidth}, {1, 0, 0}, {1, kWidth, 0}, {1, 0, kWidth}},
                   {{0, 2, 1}, {3, 4, 5}, {0, 1, 3}, {1, 4, 3}, {1, 2, 4}, {2, 5, 4}, {2, 0, 5}, {0, 3, 5}}};
  for (Kernel kernel : {Kernel::simd, Kernel::scalar}) {
    const OcclusionMask mask = query(prism, {0, 0.49f * kWidth, 0.49f * kWidth}, {0, 1, 1}, kernel);
    EXPECT_EQ(mask.count(), 64);
  }
}

}  // namespace
}  // namespace lkao::tests
