#include "bake/places.h"

#include <gtest/gtest.h>

#include "bake/meshes.h"

namespace lkao::bake {
namespace {

std::size_t count_places(const Mesh& mesh, NormalSource source, Per per) {
  return make_places(CornerNormals(mesh, source), per).count;
}

TEST(Places, AreJoinedOverSeamsAndNotOverCreases) {
  const Mesh split = split_room(), shared = joined(split);
  EXPECT_EQ(count_places(split, NormalSource::facet, Per::vertex), 24u);
  EXPECT_EQ(count_places(split, NormalSource::facet, Per::corner), 24u);
  EXPECT_EQ(count_places(shared, NormalSource::facet, Per::vertex), 8u);
  EXPECT_EQ(count_places(shared, NormalSource::facet, Per::corner), 24u);
  // A smooth box has no creases.
  EXPECT_EQ(count_places(split, NormalSource::smooth, Per::corner), 8u);
}

TEST(Places, GoByTheNormalsOfTheFile) {
  Mesh mesh = joined(split_room());
  mesh.normals = {{0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}};
  for (std::uint32_t face = 0; face < 6; ++face)
    mesh.normal_corners.insert(mesh.normal_corners.end(), 2, glm::uvec3(face));
  EXPECT_EQ(count_places(mesh, NormalSource::file, Per::corner), 24u);
  EXPECT_EQ(count_places(mesh, NormalSource::file, Per::vertex), 8u);
}

TEST(Places, UnusedVerticesHaveNone) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {7, 7, 7}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(count_places(mesh, NormalSource::facet, Per::vertex), 3u);
}

TEST(SplitVertices, AppendsAVertexForEachFurtherValue) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};
  Places places;
  places.of_corner = {{0, 1, 2}, {3, 2, 4}, {5, 4, 1}};
  places.count = 6;
  const std::vector<float> values = split_vertices(mesh, places, std::vector<float>{0.1f, 0, 0, 0.2f, 0, 0.2f});
  EXPECT_EQ(values, (std::vector<float>{0.1f, 0, 0, 0, 0.2f}));
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {4, 2, 3}, {4, 3, 1}}));
  ASSERT_EQ(mesh.positions.size(), 5u);
  EXPECT_EQ(mesh.positions[4], mesh.positions[0]);
}

}  // namespace
}  // namespace lkao::bake
