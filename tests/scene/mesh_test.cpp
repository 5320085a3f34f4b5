// Meshes in memory: bounds, normals, defects, radii, PLY out.
#include "scene/mesh.h"

#include <cmath>
#include <limits>
#include <sstream>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "bvh/usable_triangle.h"
#include "scene/defects.h"
#include "scene/files.h"
#include "scene/ply_writer.h"
#include "scene/radius.h"

namespace lkao::scene::mesh_test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Mesh unit_triangle() { return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}; }

TEST(TurnRound, TurnsTrianglesAndTheirNormals) {
  Mesh mesh = unit_triangle();
  mesh.normals = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  mesh.normal_corners = {{0, 1, 2}};
  turn_round(mesh);
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 2, 1}}));
  EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, -1));
  EXPECT_EQ(mesh.normal_corners, (std::vector<glm::uvec3>{{0, 2, 1}}));  // each corner keeps its own
  EXPECT_EQ(vertex_normals(mesh)[0], glm::vec3(0, 0, -1));
}

TEST(Mesh, TextureCoordinatesStayWithTheirCorners) {
  Mesh mesh = unit_triangle();
  mesh.uvs = {{0, 1}, {1, 1}, {0, 0}};
  mesh.uv_corners = {{0, 1, 2}};
  mesh.materials = {7};
  turn_round(mesh);
  EXPECT_EQ(mesh.uv_corners, (std::vector<glm::uvec3>{{0, 2, 1}}));

  append(mesh, unit_triangle());
  const std::vector<glm::uvec3> joined = {{0, 2, 1}, glm::uvec3(kNoUv)};
  EXPECT_EQ(mesh.uv_corners, joined);
  EXPECT_EQ(mesh.materials, (std::vector<std::uint32_t>{7, kNoMaterial}));
  Mesh plain = unit_triangle();
  append(plain, mesh);
  EXPECT_EQ(plain.uv_corners, (std::vector<glm::uvec3>{glm::uvec3(kNoUv), {0, 2, 1}, glm::uvec3(kNoUv)}));
  EXPECT_TRUE(plain.materials.empty());

  mesh.triangles.insert(mesh.triangles.begin(), glm::uvec3(0));
  mesh.uv_corners.insert(mesh.uv_corners.begin(), glm::uvec3(1));
  mesh.materials.insert(mesh.materials.begin(), 3);
  drop_bad_triangles(mesh);
  EXPECT_EQ(mesh.uv_corners, joined);
  EXPECT_EQ(mesh.materials, (std::vector<std::uint32_t>{7, kNoMaterial}));
}

TEST(Mesh, CountsCornersWithoutNormal) {
  Mesh mesh = unit_triangle();
  EXPECT_EQ(count_corners_without_normal(mesh), 3);
  mesh.normals = {{0, 0, 1}};
  mesh.normal_corners = {{0, kNoNormal, 0}};
  EXPECT_EQ(count_corners_without_normal(mesh), 1);
}

TEST(ZeroArea, CornersOnALineHaveNone) {
  EXPECT_TRUE(bvh::has_zero_area({1, 2, 3}, {1, 2, 3}, {4, 5, 6}));
  EXPECT_TRUE(bvh::has_zero_area({0, 0, 0}, {1, 1, 1}, {3, 3, 3}));
  // Collinear in floats only because 0.1f, 0.2f and 0.4f are exact doubles of each other.
  EXPECT_TRUE(bvh::has_zero_area({0.1f, 0.1f, 0}, {0.2f, 0.2f, 0}, {0.4f, 0.4f, 0}));
}

TEST(ZeroArea, TheThinnestNeedleHasSome) {
  const float above = std::nextafter(1.0f, 2.0f);
  EXPECT_FALSE(bvh::has_zero_area({0, 0, 0}, {1, 1, 0}, {1, above, 0}));
  const float tiny = std::numeric_limits<float>::denorm_min();
  EXPECT_FALSE(bvh::has_zero_area({0, 0, 0}, {tiny, 0, 0}, {0, tiny, 0}));
  const float huge = std::numeric_limits<float>::max();
  EXPECT_FALSE(bvh::has_zero_area({0, 0, 0}, {huge, 0, 0}, {0, huge, 0}));
}

TEST(Mesh, BoundsIgnoreUnusedAndNonFiniteVertices) {
  Mesh mesh = unit_triangle();
  mesh.positions.insert(mesh.positions.end(), {{100, 100, 100}, {kNan, -5, 0}, {0, 0, -7}});
  mesh.triangles.emplace_back(0, 4, 5);
  const Bounds bounds = bounds_of(mesh);
  EXPECT_EQ(bounds.lower, glm::vec3(0, 0, -7));
  EXPECT_EQ(bounds.upper, glm::vec3(1, 1, 0));
  EXPECT_GT(bounds_of(Mesh{}).lower.x, bounds_of(Mesh{}).upper.x);
}

TEST(Mesh, AppendMovesIndices) {
  Mesh mesh = unit_triangle();
  append(mesh, unit_triangle());
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.triangles[1], glm::uvec3(3, 4, 5));
}

TEST(VertexNormals, WeighByAngleNotByTriangleCount) {
  // A corner of a cube whose x face is cut into two triangles at the corner: the diagonal all the same.
  const Mesh mesh = {{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}, {1, 0, 0}},
                     {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
  const glm::vec3 normal = vertex_normals(mesh)[0];
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(normal[axis], 1 / std::sqrt(3.0), 1e-6);
}

TEST(VertexNormals, AreZeroWithoutUsableTriangles) {
  Mesh mesh = unit_triangle();
  mesh.positions.insert(mesh.positions.end(), {{5, 5, 5}, {6, 6, 6}, {7, 7, 7}, {kNan, 0, 0}});
  mesh.triangles.emplace_back(3, 4, 5);  // on a line
  mesh.triangles.emplace_back(0, 1, 6);  // with a NaN
  const std::vector<glm::vec3> normals = vertex_normals(mesh);
  EXPECT_EQ(normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(normals[4], glm::vec3(0));
  EXPECT_EQ(normals[6], glm::vec3(0));
}

TEST(Defects, EachKindIsCountedOnce) {
  Mesh mesh = unit_triangle();
  mesh.positions.insert(mesh.positions.end(), {{2, 0, 0}, {kNan, 0, 0}, {0, kInfinity, 0}, {-0.0f, 1, 0}, {9, 9, 9}});
  mesh.triangles.emplace_back(0, 1, 3);  // on a line
  mesh.triangles.emplace_back(1, 1, 2);  // a corner twice
  mesh.triangles.emplace_back(0, 1, 4);  // NaN
  mesh.triangles.emplace_back(0, 5, 5);  // infinite, and a corner twice
  mesh.triangles.emplace_back(6, 1, 0);  // the first again: another order, another vertex, -0 for 0
  const Defects defects = find_defects(mesh);
  EXPECT_EQ(defects.zero_area_count, 2u);
  EXPECT_EQ(defects.non_finite_count, 2u);
  EXPECT_EQ(defects.duplicate_count, 1u);
  EXPECT_EQ(defects.unused_vertex_count, 1u);
}

TEST(Defects, DroppingLeavesGoodTrianglesInOrder) {
  Mesh mesh = unit_triangle();
  mesh.positions.insert(mesh.positions.end(), {{2, 0, 0}, {kNan, 0, 0}});
  mesh.triangles = {{0, 1, 3}, {0, 1, 2}, {0, 1, 4}, {2, 1, 0}};
  drop_bad_triangles(mesh);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.triangles[0], glm::uvec3(0, 1, 2));
  EXPECT_EQ(mesh.triangles[1], glm::uvec3(2, 1, 0));
  EXPECT_EQ(mesh.positions.size(), 5u);
}

TEST(Radius, SharesOfTheDiagonalToTwoDigits) {
  const SuggestedRadii radii = suggest_radii({{-20.141f, -15.312f, -8.4968f}, {20.141f, 15.3f, 8.4968f}});
  EXPECT_FLOAT_EQ(radii.small, 0.75f);
  EXPECT_FLOAT_EQ(radii.large, 2.2f);
  EXPECT_EQ(suggest_radii(bounds_of(Mesh{})).small, 0);
}

TEST(PlyWriter, IsReadBackBitForBit) {
  Mesh mesh = unit_triangle();
  mesh.positions[1] = {0.1f, -1e-30f, 12345.678f};
  mesh.positions.emplace_back(4, 4, 4);
  mesh.triangles.emplace_back(3, 1, 0);
  std::ostringstream out;
  write_ply(out, mesh, std::vector<float>{0, 0.5f, 1, kNan});
  const TemporaryFolder folder;
  const Mesh read = read_mesh_file(folder.write("a.ply", out.str()));
  EXPECT_EQ(read.positions, mesh.positions);
  EXPECT_EQ(read.triangles, mesh.triangles);
}

TEST(PlyWriter, GreyIsTheSrgbVisibility) {
  std::ostringstream out;
  write_ply(out, unit_triangle(), std::vector<float>{0, 0.5f, 1});
  const std::string text = out.str();
  const std::size_t data = text.find("end_header\n") + 11;
  constexpr std::size_t kStride = 19;
  EXPECT_EQ(static_cast<unsigned char>(text[data + 16]), 255);
  EXPECT_EQ(static_cast<unsigned char>(text[data + kStride + 16]), 188);  // 255 x (1.055 x 0.5^(1/2.4) - 0.055)
  EXPECT_EQ(static_cast<unsigned char>(text[data + 2 * kStride + 16]), 0);
  EXPECT_EQ(text.size(), data + 3 * kStride + 13);
  EXPECT_EQ(text.substr(data + kStride + 12, 4), raw(0.5f));
}

TEST(PlyWriter, LinearGreyAndQualityAreTheVisibility) {
  std::ostringstream out;
  write_ply(out, unit_triangle(), std::vector<float>{0, 0.75f, 1}, {.coding = ColourCoding::linear, .quality = true});
  const std::string text = out.str();
  const std::size_t data = text.find("property float quality\nelement face") == std::string::npos
                               ? std::string::npos
                               : text.find("end_header\n") + 11;
  ASSERT_NE(data, std::string::npos);
  constexpr std::size_t kStride = 23;
  EXPECT_EQ(static_cast<unsigned char>(text[data + kStride + 16]), 64);
  EXPECT_EQ(text.substr(data + kStride + 19, 4), raw(0.25f));
  EXPECT_EQ(text.size(), data + 3 * kStride + 13);
}

TEST(PlyWriter, FacesHaveTheirValuesBehindTheirCorners) {
  std::ostringstream out;
  write_ply_of_faces(out, unit_triangle(), std::vector<float>{0.5f});
  const std::string text = out.str();
  EXPECT_NE(text.find("vertex_indices\nproperty float occlusion\n"), std::string::npos);
  const std::size_t data = text.find("end_header\n") + 11;
  EXPECT_EQ(text.size(), data + 3 * 12 + 13 + 7);
  EXPECT_EQ(text.substr(data + 3 * 12 + 13, 4), raw(0.5f));
  EXPECT_EQ(static_cast<unsigned char>(text[data + 3 * 12 + 13 + 4]), 188);
  const TemporaryFolder folder;
  EXPECT_EQ(read_mesh_file(folder.write("a.ply", text)).triangles, unit_triangle().triangles);
}

TEST(PlyWriter, NamesTheOrigin) {
  Mesh mesh = unit_triangle();
  mesh.origin = {500000.5, -5e6, 0};
  std::ostringstream out;
  write_ply(out, mesh);
  EXPECT_NE(out.str().find("1.0\ncomment origin 500000.5 -5000000 0\nelement vertex"), std::string::npos);
}

TEST(PlyWriter, RefusesTheWrongNumberOfValues) {
  std::ostringstream out;
  EXPECT_THROW(write_ply_of_faces(out, unit_triangle(), std::vector<float>{0, 1}), std::invalid_argument);
  EXPECT_THROW(write_ply(out, unit_triangle(), std::vector<float>{0, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace lkao::scene::mesh_test
