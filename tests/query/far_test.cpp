// A scene far from zero, in double, gives what it gives at zero.
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "lkao/lkao.h"
#include "support/meshes.h"
#include "support/receivers.h"

namespace lkao {
namespace {

// UTM coordinates. A double moves there in steps of 2^-30: sums with multiples of 2^-20 are exact.
constexpr glm::dvec3 kPlace(448262.0, 5413678.0, 112.0);

tests::Mesh rounded_soup() {
  tests::Mesh mesh = tests::random_soup(300, 0.3f, 5);
  for (glm::vec3& p : mesh.positions) p = glm::vec3(glm::ivec3(p * 0x1p20f)) * 0x1p-20f;
  return mesh;
}

std::vector<glm::dvec3> far_positions(const tests::Mesh& mesh) {
  std::vector<glm::dvec3> positions;
  for (const glm::vec3& p : mesh.positions) positions.push_back(glm::dvec3(p) + kPlace);
  return positions;
}

TEST(FarScene, HasTheBitsOfTheSceneAtZero) {
  const tests::Mesh mesh = rounded_soup();
  const std::vector<glm::dvec3> positions = far_positions(mesh);
  const RayOptions options{.radius = 0.7f};
  const AmbientOcclusion near(OccluderBvh(mesh.view()), SamplePattern::standard(128), options);
  const AmbientOcclusion far(OccluderBvh({{positions, kPlace}, mesh.triangles}), SamplePattern::standard(128), options);
  EXPECT_EQ(far.occluders().origin(), kPlace);
  const std::vector<Receiver> receivers = tests::random_receivers(200, 1, 6);
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    EXPECT_EQ(far.blocked(receivers[i], i), near.blocked(receivers[i], i)) << i;
  }
}

TEST(FarScene, ChoosesAnOriginNearIt) {
  const std::vector<glm::dvec3> positions = far_positions(rounded_soup());
  const glm::dvec3 origin = choose_origin({positions, glm::dvec3(0)});
  const Bounds bounds = OccluderBvh({{positions, origin}, rounded_soup().triangles}).bounds();
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LT(std::abs(origin[axis] - kPlace[axis]), 10);
    EXPECT_LT(std::abs(bounds.lower[axis]), 10);
  }
}

TEST(FarScene, LevelsMustHaveOneOrigin) {
  const tests::Mesh mesh = rounded_soup();
  const std::vector<glm::dvec3> positions = far_positions(mesh);
  const std::vector<OccluderLevel> levels = {{OccluderBvh({{positions, kPlace}, mesh.triangles}), 0, 1},
                                             {OccluderBvh(mesh.view()), 1, 2}};
  EXPECT_THROW(AmbientOcclusion(levels, SamplePattern::standard(64), {.radius = 1}), std::invalid_argument);
}

}  // namespace
}  // namespace lkao
