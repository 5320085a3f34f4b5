#include "scene/corner_normals.h"

#include <cmath>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "scene/shapes.h"
#include "scene/shared_edges.h"

namespace lkao::scene {
namespace {

void expect_near(const glm::vec3& a, const glm::vec3& b) { EXPECT_LT(glm::distance(a, b), 1e-6f); }

// Two halves of a roof, its ridge at x = 0, on vertices of their own.
Mesh roof() {
  return {{{-1, -1, 1}, {0, 0, 1}, {0, 0, -1}, {1, -1, 1}, {0, 0, -1}, {0, 0, 1}}, {{0, 1, 2}, {3, 4, 5}}};
}

TEST(SharedEdges, AreFoundByPosition) {
  const std::vector<SharedEdge> edges = shared_edges(roof());
  ASSERT_EQ(edges.size(), 1u);
  const auto& [a, b] = edges[0].sides;
  const Mesh mesh = roof();
  const auto place = [&](const EdgeSide& side, std::uint32_t corner) {
    return mesh.positions[mesh.triangles[side.triangle][static_cast<int>(corner)]];
  };
  EXPECT_EQ(place(a, a.from), place(b, b.to()));
  EXPECT_EQ(place(a, a.to()), place(b, b.from));
  EXPECT_NE(a.triangle, b.triangle);
}

TEST(SharedEdges, RunAgainstEachOther) {
  Mesh mesh = roof();
  std::swap(mesh.triangles[1].y, mesh.triangles[1].z);
  EXPECT_TRUE(shared_edges(mesh).empty());
}

// A knot of very many triangles costs no more than they are.
TEST(SharedEdges, OfAKnotStayFew) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 1}};
  constexpr std::uint32_t kCount = 20000;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    mesh.positions.emplace_back(std::cos(static_cast<float>(i)), std::sin(static_cast<float>(i)), 0);
    const std::uint32_t tip = i + 2;
    mesh.triangles.push_back(i % 2 == 0 ? glm::uvec3(0, 1, tip) : glm::uvec3(1, 0, tip));
  }
  EXPECT_LE(shared_edges(mesh).size(), 10u * kCount);
}

TEST(CornerNormals, OfFacetsAreTheirOwn) {
  const Mesh mesh = roof();
  const CornerNormals normals(mesh, NormalSource::facet);
  for (const glm::vec3& normal : normals.of(0).corners) expect_near(normal, glm::vec3(-1, 1, 0) / std::sqrt(2.0f));
}

TEST(CornerNormals, SmoothOnesIgnoreSeams) {
  const Mesh mesh = roof();
  const CornerNormals normals(mesh, NormalSource::smooth);
  const auto left = normals.of(0).corners, right = normals.of(1).corners;
  expect_near(left[1], {0, 1, 0});
  EXPECT_EQ(left[1], right[2]);
  EXPECT_EQ(left[2], right[1]);
  expect_near(left[0], glm::vec3(-1, 1, 0) / std::sqrt(2.0f));
}

// Front and back of a leaf, on the same vertices: they do not cancel.
TEST(CornerNormals, SmoothOnesOfALeafStayOnTheirSide) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 2, 1}, {0, 3, 2}};
  const CornerNormals normals(mesh, NormalSource::smooth);
  for (std::size_t t = 0; t < 4; ++t) {
    for (const glm::vec3& normal : normals.of(t).corners) EXPECT_EQ(normal, glm::vec3(0, 0, t < 2 ? 1 : -1)) << t;
  }
}

TEST(CornerNormals, OfAFileSayWhatIsInFront) {
  Mesh mesh = roof();
  const glm::vec3 down(0, -1, 0);
  mesh.normals = {down};
  mesh.normal_corners = {{0, 0, 0}, {0, kNoNormal, 0}};
  const CornerNormals normals(mesh, NormalSource::file);
  EXPECT_EQ(normals.of(0).corners[0], down);
  expect_near(glm::vec3(normals.of(0).facet), glm::vec3(1, -1, 0) / std::sqrt(2.0f));
  EXPECT_EQ(normals.of(1).corners[2], down);
  // The smooth one points to the other side of the plane.
  expect_near(normals.of(1).corners[1], glm::vec3(-1, -1, 0) / std::sqrt(2.0f));
  EXPECT_EQ(usual_normals(mesh), NormalSource::file);
  EXPECT_EQ(usual_normals(roof()), NormalSource::facet);
}

// All of a sphere of facets point away from its centre.
TEST(CornerNormals, SmoothOnesOfASpherePointOutwards) {
  const glm::dvec3 center(1, 2, 3);
  Mesh mesh;
  add_sphere(mesh, center, 2, 48, 24);
  const CornerNormals normals(mesh, NormalSource::smooth);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 outwards = glm::normalize(glm::dvec3(mesh.positions[mesh.triangles[t][i]]) - center);
      EXPECT_GT(glm::dot(outwards, glm::dvec3(normals.of(t).corners[static_cast<std::size_t>(i)])), 0.99);
    }
  }
}

}  // namespace
}  // namespace lkao::scene
