#include "bake/face_samples.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "bake/meshes.h"
#include "scene/facet.h"

namespace lkao::bake {
namespace {

// A small triangle and one of a hundred times its area.
Mesh unequal() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 5}, {10, 0, 5}, {0, 10, 5}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  return mesh;
}

TEST(FaceSamples, LieInTheirTrianglesEvenly) {
  const Mesh mesh = unequal();
  for (const std::uint64_t seed : {0u, 7u}) {
    const FaceSamples samples = sample_faces(CornerNormals(mesh, NormalSource::facet), {.most_rows = 8, .seed = seed});
    ASSERT_EQ(samples.firsts.size(), 3u);
    EXPECT_EQ(samples.firsts[1], 4u);
    EXPECT_GE(samples.firsts[2], 8u);
    glm::dvec3 mean(0.0);
    for (std::size_t i = 0; i < samples.receivers.size(); ++i) {
      const glm::dvec3& w = samples.weights[i];
      EXPECT_GE(std::min(w.x, std::min(w.y, w.z)), 0);
      EXPECT_NEAR(w.x + w.y + w.z, 1, 1e-12);
      if (i < 4) continue;
      const glm::dvec3 place = w.x * glm::dvec3(mesh.positions[3]) + w.y * glm::dvec3(mesh.positions[4]) +
                               w.z * glm::dvec3(mesh.positions[5]);
      EXPECT_LT(glm::distance(place, glm::dvec3(samples.receivers[i].position)), 1e-5);
      mean += w / static_cast<double>(samples.receivers.size() - 4);
    }
    // Evenly: the mean is the middle.
    EXPECT_LT(glm::distance(mean, glm::dvec3(1.0 / 3)), seed == 0 ? 1e-12 : 0.15);
  }
}

TEST(FaceSamples, AverageOnTheirFaces) {
  const Mesh mesh = unequal();
  const FaceSamples samples = sample_faces(CornerNormals(mesh, NormalSource::facet));
  std::vector<float> occlusion(samples.receivers.size(), 0.75f);
  occlusion[0] = std::numeric_limits<float>::quiet_NaN();
  occlusion[1] = 0;
  EXPECT_EQ(average_on_faces(samples, occlusion), (std::vector<float>{0.5f, 0.75f}));
}

TEST(FaceSamples, OfAClosedRoomAreWhollyDark) {
  const Mesh mesh = split_room();
  const FaceSamples samples = sample_faces(CornerNormals(mesh, NormalSource::facet));
  for (const float value : average_on_faces(samples, ask(mesh, samples.receivers, 100))) EXPECT_EQ(value, 1);
}

}  // namespace
}  // namespace lkao::bake
