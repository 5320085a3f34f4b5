#include "lod/parts.h"

#include <limits>

#include <gtest/gtest.h>

#include "lod/meshes.h"
#include "lod/triangle_pairs.h"

namespace lkao::lod {
namespace {

std::size_t triangle_count(const SceneParts& scene) {
  std::size_t count = 0;
  for (const Part& part : scene.parts) count += part.mesh.triangles.size();
  return count;
}

void expect_all_accounted_for(const scene::Mesh& mesh) {
  const SceneParts scene = split_into_parts(mesh);
  EXPECT_EQ(triangle_count(scene) + scene.zero_area_count + scene.non_finite_count + scene.duplicate_count,
            mesh.triangles.size());
  for (const Part& part : scene.parts) {
    ASSERT_EQ(part.scene_vertices.size(), part.mesh.positions.size());
    for (std::size_t i = 0; i < part.scene_vertices.size(); ++i) {
      EXPECT_EQ(part.mesh.positions[i], scene.positions[part.scene_vertices[i]]);
    }
  }
}

TEST(Parts, EqualPositionsAreJoined) {
  // Two triangles with corners of their own, one written with -0: one part of four vertices.
  const scene::Mesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, -0.0f}, {1, 1, 0}, {-0.0f, 1, 0}},
                         .triangles = {{0, 1, 2}, {3, 4, 5}}};
  const SceneParts scene = split_into_parts(mesh);
  ASSERT_EQ(scene.parts.size(), 1u);
  EXPECT_EQ(scene.parts[0].mesh.positions.size(), 4u);
  EXPECT_EQ(scene.positions.size(), 4u);
}

TEST(Parts, AFloorGoesOnBelowAWall) {
  // Two triangles of a floor and one of a wall on their common edge 0-1.
  const scene::Mesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 0, -1}, {0, 1, 0}},
                         .triangles = {{0, 1, 4}, {0, 2, 1}, {0, 1, 3}}};
  const SceneParts scene = split_into_parts(mesh);
  EXPECT_EQ(scene.crowded_edge_count, 1u);
  ASSERT_EQ(scene.parts.size(), 2u);
  EXPECT_EQ(scene.parts[0].mesh.triangles.size(), 1u);  // the wall
  EXPECT_EQ(scene.parts[1].mesh.triangles.size(), 2u);
  EXPECT_EQ(scene.split_vertex_count, 2u);
}

TEST(Parts, TheTwoSidesOfASheetStayApart) {
  scene::Mesh mesh = flat_grid(2);
  const std::vector<glm::uvec3> front = mesh.triangles;
  for (const glm::uvec3& t : front) mesh.triangles.emplace_back(t.x, t.z, t.y);
  const SceneParts scene = split_into_parts(mesh);
  EXPECT_EQ(scene.duplicate_count, 0u);
  EXPECT_EQ(triangle_count(scene), 16u);
  // All inner edges have a pair on each side; at the rim the sides are joined.
  EXPECT_EQ(scene.crowded_edge_count, 8u);
  const TrianglePairs pairs = pair_triangles(mesh.positions, mesh.triangles);
  for (HalfEdge edge = 0; edge < pairs.partner.size(); ++edge) {
    ASSERT_NE(pairs.partner[edge], kNoHalfEdge);
    EXPECT_EQ(pairs.partner[pairs.partner[edge]], edge);
  }
}

TEST(Parts, ABowTieIsTwoParts) {
  const scene::Mesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}},
                         .triangles = {{0, 1, 2}, {0, 3, 4}}};
  const SceneParts scene = split_into_parts(mesh);
  EXPECT_EQ(scene.parts.size(), 2u);
  EXPECT_EQ(scene.split_vertex_count, 1u);
  EXPECT_EQ(scene.positions.size(), 5u);
}

TEST(Parts, OppositeWindingsDoNotJoin) {
  const scene::Mesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}},
                         .triangles = {{0, 1, 2}, {1, 2, 3}}};
  const SceneParts scene = split_into_parts(mesh);
  EXPECT_EQ(scene.wrong_winding_edge_count, 1u);
  EXPECT_EQ(scene.parts.size(), 2u);
}

TEST(Parts, DuplicatesGoUnlessTheyWindTheOtherWay) {
  const scene::Mesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                         .triangles = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}}};
  const SceneParts scene = split_into_parts(mesh);
  EXPECT_EQ(scene.duplicate_count, 2u);
  EXPECT_EQ(triangle_count(scene), 2u);
}

TEST(Parts, EveryTriangleIsAccountedFor) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  scene::Mesh mesh = wavy_grid(5);
  const auto first = static_cast<unsigned>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {{nan, 0, 0}, {9, 9, 9}, {9, 9, 8}, {9, 8, 9}, {0.2f, 1, 0.2f}});
  mesh.triangles.insert(mesh.triangles.end(), {{0, 1, first},                      // not finite
                                               {0, 0, 1},                          // of no area
                                               mesh.triangles[3],                  // a duplicate
                                               {first + 1, first + 2, first + 3},  // alone
                                               {7, 8, first + 4},                  // a wall on the grid
                                               {8, 7, first + 4}});                // and its back
  const SceneParts scene = split_into_parts(mesh);
  EXPECT_EQ(scene.non_finite_count, 1u);
  EXPECT_EQ(scene.zero_area_count, 1u);
  EXPECT_EQ(scene.duplicate_count, 1u);
  expect_all_accounted_for(mesh);
  expect_all_accounted_for(ball(1, 12));
}

}  // namespace
}  // namespace lkao::lod
