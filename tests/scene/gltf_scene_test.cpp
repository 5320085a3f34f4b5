// glTF: nodes, instances, and what a scene holds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/gltf_reading.h"

namespace lkao::scene {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(GltfScene, NodeTransformsMultiplyDownTheTree) {
  GltfBuilder parts = gltf_square({0, 1, 2});
  parts.document["nodes"] = {{{"translation", {0, 0, 5}}, {"scale", {2, 2, 2}}, {"children", {1, 2}}},
                             {{"mesh", 0}, {"rotation", {0, 0, 1, 0}}},  // half a turn about z
                             {{"mesh", 0}, {"translation", {10, 0, 0}}}};
  const FileMesh mesh = read(parts);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_LT(glm::distance(corners(mesh, 0)[2], glm::dvec3(-2, -2, 5)), 1e-12);
  EXPECT_EQ(corners(mesh, 1)[2], glm::dvec3(22, 2, 5));
}

TEST(GltfScene, MatricesAreByColumns) {
  GltfBuilder parts = gltf_cube();
  parts.node(0)["matrix"] = {0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 10, 20, 30, 1};  // x to 2 y, y to -x
  expect_box(read(parts), {9, 20, 30}, {10, 22, 31});
  parts.node(0)["matrix"] = {1, 2, 3};
  EXPECT_THAT(refusal(parts), HasSubstr("nodes[0].matrix has 3 numbers, not 16"));
}

TEST(GltfScene, MirroringNodesKeepTheFront) {
  // The square looks along +z; mirrored in x it still does.
  GltfBuilder parts = gltf_square({0, 1, 2, 0, 2, 3});
  parts.node(0)["scale"] = {-2, 1, 1};
  const FileMesh mesh = read(parts);
  for (std::size_t t = 0; t < 2; ++t) EXPECT_EQ(front(mesh, t), glm::dvec3(0, 0, 2));
  expect_box(mesh, {-2, 0, 0}, {0, 1, 0});
}

TEST(GltfScene, PositionsKeepDoublePrecision) {
  GltfBuilder parts = gltf_cube();
  parts.node(0)["translation"] = {448262.015625, 5413678.25, 0.125};
  EXPECT_EQ(read(parts).positions[6], glm::dvec3(448263.015625, 5413679.25, 1.125));
}

TEST(GltfScene, NormalsFollowTheInverseTranspose) {
  GltfBuilder parts = gltf_square({0, 1, 2, 0, 2, 3});
  std::vector<glm::vec3> normals(4, glm::vec3(1, 1, 0));
  parts.primitive()["attributes"]["NORMAL"] = parts.add_values(normals, kFloat, "VEC3", 1);
  parts.node(0)["scale"] = {-2, 1, 1};
  const FileMesh mesh = read(parts);
  ASSERT_EQ(mesh.normals.size(), 4u);
  EXPECT_EQ(mesh.normal_corners, mesh.triangles);
  const glm::vec3 expected = glm::normalize(glm::vec3(-0.5f, 1, 0));
  for (const glm::vec3& normal : mesh.normals) EXPECT_LT(glm::distance(normal, expected), 1e-6f);
}

// Cubes at x = 0, 10, 20 in the nodes 0, 1, 2.
GltfBuilder three_cubes() {
  GltfBuilder parts = gltf_cube();
  parts.document["nodes"] = {
      {{"mesh", 0}}, {{"mesh", 0}, {"translation", {10, 0, 0}}}, {{"mesh", 0}, {"translation", {20, 0, 0}}}};
  return parts;
}

TEST(GltfScene, OneSceneIsShown) {
  GltfBuilder parts = three_cubes();
  parts.document["scenes"] = {{{"nodes", {1}}}, {{"nodes", {2}}}};
  parts.document["scene"] = 1;
  expect_box(read(parts), {20, 0, 0}, {21, 1, 1});
  parts.document.erase("scene");
  expect_box(read(parts), {10, 0, 0}, {11, 1, 1});
  parts.document.erase("scenes");
  expect_box(read(parts), {0, 0, 0}, {21, 1, 1});
  parts.document["scene"] = 2;
  EXPECT_THAT(refusal(parts), HasSubstr("scene names scenes[2], which does not exist"));
}

TEST(GltfScene, HiddenNodesHideTheirChildren) {
  GltfBuilder parts = three_cubes();
  parts.document["scenes"][0]["nodes"] = {0, 1};
  parts.node(1)["children"] = {2};
  parts.node(1)["extensions"]["KHR_node_visibility"]["visible"] = false;
  parts.document["extensionsRequired"] = {"KHR_node_visibility"};
  const FileMesh mesh = read(parts);
  expect_box(mesh, {0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(mesh.contents.hidden_count, 2u);
  EXPECT_EQ(mesh.contents.node_count, 1u);
  parts.node(1)["extensions"]["KHR_node_visibility"]["visible"] = true;
  EXPECT_EQ(read(parts).contents.node_count, 3u);
}

TEST(GltfScene, NodesMustBeTrees) {
  GltfBuilder parts = three_cubes();
  parts.node(1)["children"] = {2};
  parts.node(2)["children"] = {1};
  EXPECT_THAT(refusal(parts), HasSubstr("nodes[1] is in a circle of nodes"));
  parts.node(2)["children"] = {2};
  EXPECT_THAT(refusal(parts), HasSubstr("nodes[2] is a child of nodes[1] and of nodes[2]"));
  parts.node(2)["children"] = {3};
  EXPECT_THAT(refusal(parts), HasSubstr("nodes[2].children[0] names nodes[3], which does not exist"));
  parts.node(2).erase("children");
  parts.node(0)["children"] = {1, 2};
  EXPECT_THAT(refusal(parts), HasSubstr("nodes[2] is a child of nodes[0] and of nodes[1]"));
}

TEST(GltfScene, LongChainsOfNodesAreWalked) {
  constexpr std::size_t kCount = 20000;
  GltfBuilder parts = gltf_cube();
  parts.document["nodes"] = json::array();
  for (std::size_t i = 0; i < kCount; ++i) {
    parts.document["nodes"].push_back({{"children", {i + 1}}, {"translation", {1, 0, 0}}});
  }
  parts.document["nodes"].push_back({{"mesh", 0}});
  expect_box(read(parts), {kCount, 0, 0}, {kCount + 1, 1, 1});
}

// ---- EXT_mesh_gpu_instancing ----

json& instancing(GltfBuilder& parts) { return parts.node(0)["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]; }

TEST(GltfInstances, AreMovedTurnedAndScaled) {
  GltfBuilder parts = gltf_cube();
  parts.node(0)["translation"] = {0, 0, 100};
  parts.document["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  const std::vector<glm::vec3> places{{0, 0, 0}, {10, 0, 0}};
  const std::vector<glm::vec3> scales{{1, 1, 1}, {2, 2, 2}};
  // The second: a quarter turn about z, as normalised shorts.
  const std::vector<std::int16_t> turns{0, 0, 0, 32767, 0, 0, 23170, 23170};
  instancing(parts)["TRANSLATION"] = parts.add_values(places, kFloat, "VEC3", 1);
  expect_box(read(parts), {0, 0, 100}, {11, 1, 101});
  instancing(parts)["SCALE"] = parts.add_values(scales, kFloat, "VEC3", 1);
  expect_box(read(parts), {0, 0, 100}, {12, 2, 102});
  const std::size_t rotation = parts.add_values(turns, kInt16, "VEC4", 4);
  parts.document["accessors"][rotation]["normalized"] = true;
  instancing(parts)["ROTATION"] = rotation;
  instancing(parts)["_ID"] = 0;
  const FileMesh mesh = read(parts);
  expect_box(mesh, {0, 0, 100}, {10, 2, 102});
  EXPECT_EQ(mesh.triangles.size(), 24u);
  EXPECT_EQ(mesh.contents.node_count, 1u);
  EXPECT_EQ(mesh.contents.instance_count, 2u);
  EXPECT_NEAR(volume(mesh), 1 + 8, 1e-3);
}

TEST(GltfInstances, HaveAsManyOfEachAttribute) {
  GltfBuilder parts = gltf_cube();
  instancing(parts)["TRANSLATION"] = parts.add_values(std::vector<glm::vec3>(3), kFloat, "VEC3", 1);
  instancing(parts)["SCALE"] = parts.add_values(std::vector<glm::vec3>(2), kFloat, "VEC3", 1);
  EXPECT_THAT(refusal(parts), HasSubstr("SCALE needs 3"));
}

TEST(GltfInstances, TooManyTrianglesAreCountedBeforeTheyAreMade) {
  GltfBuilder parts = gltf_cube();
  parts.primitive()["indices"] = parts.add_values(std::vector<std::uint8_t>(3 * 70000), kUint8, "SCALAR", 1);
  instancing(parts)["SCALE"] = parts.add_values(std::vector<std::uint8_t>(3 * 70000), kUint8, "VEC3", 3);
  EXPECT_THAT(refusal(parts), HasSubstr("with all instances it has 560000 vertices and 4900000000 triangles"));
}

// ---- objects ----

TEST(GltfObjects, AreWhatNodesAndInstancesShow) {
  GltfBuilder parts = three_cubes();
  parts.document["meshes"][0]["primitives"].push_back(parts.primitive());
  const FileMesh plain = read_gltf("", parts.gltf(), {.objects = true});
  const std::size_t node_count = plain.contents.node_count;
  EXPECT_EQ(plain.contents.object_count, node_count);
  ASSERT_EQ(plain.objects.size(), 24 * node_count);
  for (std::size_t t = 0; t < plain.objects.size(); ++t) EXPECT_EQ(plain.objects[t], t / 24);
  EXPECT_TRUE(read(parts).objects.empty());
  GltfBuilder instances = gltf_cube();
  instancing(instances)["TRANSLATION"] = instances.add_values(std::vector<glm::vec3>(3), kFloat, "VEC3", 1);
  EXPECT_EQ(read_gltf("", instances.gltf(), {.objects = true}).contents.object_count, 3u);
}

// ---- contents ----

TEST(GltfContents, UvSetsAreCounted) {
  GltfBuilder parts = gltf_cube();
  EXPECT_EQ(read(parts).contents.uv_set_count, 0u);
  parts.primitive()["attributes"]["TEXCOORD_1"] = 99;  // unused, and so no fault
  parts.primitive()["attributes"]["COLOR_1"] = "red";
  EXPECT_EQ(read(parts).contents.uv_set_count, 1u);
}

TEST(GltfContents, CutOutsAreNamedAsOftenAsTheyAreShown) {
  GltfBuilder parts = three_cubes();
  parts.document["scenes"][0]["nodes"] = {0, 1};
  parts.primitive()["material"] = 0;
  parts.document["materials"] = {{{"name", "leaves"}, {"alphaMode", "MASK"}}};
  const Contents contents = read(parts).contents;
  EXPECT_EQ(contents.cut_out_count, 24u);
  EXPECT_THAT(contents.remarks,
              ElementsAre("material \"leaves\" has holes by transparency: its 24 triangles block as if whole"));
  parts.document["materials"][0]["alphaMode"] = "OPAQUE";
  EXPECT_EQ(read(parts).contents.cut_out_count, 0u);
}

TEST(GltfContents, ManyCutOutsMakeFewLines) {
  GltfBuilder parts = gltf_cube();
  const json primitive = parts.primitive();
  parts.document["meshes"][0]["primitives"] = json::array();
  for (int i = 0; i < 100; ++i) {
    parts.document["materials"].push_back({{"alphaMode", "BLEND"}});
    parts.document["meshes"][0]["primitives"].push_back(primitive);
    parts.document["meshes"][0]["primitives"][static_cast<std::size_t>(i)]["material"] = i;
  }
  const Contents contents = read(parts).contents;
  EXPECT_EQ(contents.cut_out_count, 1200u);
  ASSERT_EQ(contents.remarks.size(), 4u);
  EXPECT_THAT(contents.remarks[0], HasSubstr("material \"materials[0]\" has holes"));
  EXPECT_THAT(contents.remarks[3], HasSubstr("97 more materials have holes by transparency: their 1164 triangles"));
}

}  // namespace
}  // namespace lkao::scene
