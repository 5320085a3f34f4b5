#include "lod/regions.h"

#include <algorithm>
#include <cstddef>
#include <map>

#include <gtest/gtest.h>

#include "lod/meshes.h"

namespace lkao::lod {
namespace {

HalfEdgeMesh half_edge_mesh(const scene::Mesh& mesh) {
  HalfEdgeMesh result;
  result.request_vertex_status();
  result.request_edge_status();
  result.request_face_status();
  for (const glm::vec3& p : mesh.positions) result.add_vertex({p.x, p.y, p.z});
  for (const glm::uvec3& t : mesh.triangles) {
    const auto vertex = [&](int i) { return HalfEdgeMesh::VertexHandle(static_cast<int>(t[i])); };
    result.add_face(vertex(0), vertex(1), vertex(2));
  }
  return result;
}

TEST(Regions, HoldEveryVertexOnceAndFewEach) {
  HalfEdgeMesh mesh = half_edge_mesh(wavy_grid(50));
  const std::vector<VertexGroup> groups = split_into_regions(mesh, 300);
  std::map<int, int> uses;
  for (const VertexGroup& group : groups) {
    EXPECT_LE(group.size(), 300u);
    for (const auto vertex : group) ++uses[vertex.idx()];
  }
  EXPECT_EQ(uses.size(), mesh.n_vertices());
  EXPECT_TRUE(std::ranges::all_of(uses, [](const auto& use) { return use.second == 1; }));
}

// Two inner vertices of different regions are three edges apart at least: no triangle that one collapse changes is one
// that the other looks at.
TEST(Regions, OfInnerVerticesAreApart) {
  HalfEdgeMesh mesh = half_edge_mesh(ball(1, 60));
  const std::vector<VertexGroup> groups = split_into_regions(mesh, 200);
  std::map<int, std::size_t> group_of;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    for (const auto vertex : groups[i]) group_of[vertex.idx()] = i;
  }
  std::size_t inner_count = 0;
  for (const auto vertex : mesh.vertices()) {
    if (!mesh.data(vertex).is_inside) continue;
    ++inner_count;
    for (const auto near : mesh.vv_range(vertex)) {
      EXPECT_EQ(group_of[near.idx()], group_of[vertex.idx()]);
      for (const auto far : mesh.vv_range(near)) {
        if (mesh.data(far).is_inside) {
          EXPECT_EQ(group_of[far.idx()], group_of[vertex.idx()]);
        }
      }
    }
  }
  EXPECT_GT(inner_count, mesh.n_vertices() / 2);
  EXPECT_LT(inner_count, mesh.n_vertices());
  join_regions(mesh);
  for (const auto vertex : mesh.vertices()) EXPECT_TRUE(mesh.data(vertex).is_inside);
}

}  // namespace
}  // namespace lkao::lod
