// glTF: primitives, morph targets and skins.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/gltf_reading.h"
#include "scene/mesh.h"

namespace lkao::scene {
namespace {

using nlohmann::json;
using testing::HasSubstr;

// ---- primitives ----

TEST(GltfPrimitive, StripsAndFansAreTriangles) {
  for (const GltfBuilder& parts : {gltf_square({0, 1, 3, 2}, 5), gltf_square({0, 1, 2, 3}, 6)}) {
    const FileMesh mesh = read(parts);
    ASSERT_EQ(mesh.triangles.size(), 2u);
    for (std::size_t t = 0; t < 2; ++t) EXPECT_EQ(front(mesh, t), glm::dvec3(0, 0, 1));
  }
}

TEST(GltfPrimitive, WithoutIndicesVerticesFollowEachOther) {
  GltfBuilder parts = gltf_square({});
  parts.primitive().erase("indices");
  parts.primitive()["mode"] = 6;
  const FileMesh mesh = read(parts);
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}}));
  parts.primitive()["mode"] = 4;
  EXPECT_THAT(refusal(parts), HasSubstr("meshes[0].primitives[0]: a list of triangles has 4 indices"));
}

TEST(GltfPrimitive, WhatHasNoTrianglesIsLeftOut) {
  GltfBuilder parts = gltf_cube();
  const std::size_t none = parts.add_values(std::vector<std::uint16_t>{}, kUint16, "SCALAR", 1);
  json& primitives = parts.document["meshes"][0]["primitives"];
  for (int mode = 0; mode < 4; ++mode) primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"mode", mode}});
  primitives.push_back({{"attributes", {{"NORMAL", 0}}}});
  primitives.push_back({{"attributes", json::object()}});
  primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"indices", none}});
  parts.document["accessors"].push_back({{"componentType", kFloat}, {"count", 0}, {"type", "VEC3"}});
  primitives.push_back({{"attributes", {{"POSITION", none + 1}}}});
  const FileMesh mesh = read(parts);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_EQ(mesh.positions.size(), 8u);
  primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 7}});
  EXPECT_THAT(refusal(parts), HasSubstr("meshes[0].primitives[9] has the mode 7"));
}

TEST(GltfPrimitive, BadIndicesAreRefused) {
  EXPECT_THAT(refusal(gltf_square({0, 1, 2, 0, 2, 9})),
              HasSubstr("meshes[0].primitives[0]: index 5 names vertex 9 of 4"));
  EXPECT_THAT(refusal(gltf_square({0, 1, 2, 0})), HasSubstr("a list of triangles has 4 indices"));
}

TEST(GltfPrimitive, RestartsAreRefusedByName) {
  GltfBuilder parts = gltf_square({});
  parts.primitive()["mode"] = 5;
  const std::vector<std::uint32_t> indices{0, 1, 2, 0xffffffffu, 1, 2, 3};
  parts.primitive()["indices"] = parts.add_values(indices, kUint32, "SCALAR", 1);
  EXPECT_THAT(refusal(parts), HasSubstr("index 3 names vertex 4294967295 of 4: glTF knows no primitive restart"));
}

TEST(GltfPrimitive, VerticesKeepTheirNumbersAndAreSharedWithinAMesh) {
  GltfBuilder parts = gltf_square({2, 3, 0});
  json second = parts.primitive();
  second["indices"] = parts.add_values(std::vector<std::uint16_t>{0, 1, 2}, kUint16, "SCALAR", 1);
  parts.document["meshes"][0]["primitives"].push_back(second);
  const FileMesh mesh = read(parts);
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{2, 3, 0}, {0, 1, 2}}));
  parts.document["nodes"].push_back({{"mesh", 0}});
  parts.document["scenes"][0]["nodes"] = {0, 1};
  EXPECT_EQ(read(parts).positions.size(), 8u);
  EXPECT_EQ(read(parts).triangles[2], glm::uvec3(6, 7, 4));
}

TEST(GltfPrimitive, CornersWithoutNormalsSaySo) {
  GltfBuilder parts = gltf_square({0, 1, 2});
  EXPECT_TRUE(read(parts).normal_corners.empty());
  json second = parts.primitive();
  const std::vector<std::int8_t> normals{0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0};
  const std::size_t accessor = parts.add_accessor(parts.add_view(bytes_of(normals), 4), kInt8, 4, "VEC3");
  parts.document["accessors"][accessor]["normalized"] = true;
  second["attributes"]["NORMAL"] = accessor;
  parts.document["meshes"][0]["primitives"].push_back(second);
  const FileMesh mesh = read(parts);
  ASSERT_EQ(mesh.normal_corners.size(), 2u);
  EXPECT_EQ(mesh.normal_corners[0], glm::uvec3(kNoNormal));
  EXPECT_EQ(mesh.normals[mesh.normal_corners[1].z], glm::vec3(0, 0, 1));
}

TEST(GltfPrimitive, NormalsMustBeAsManyAsPositions) {
  GltfBuilder parts = gltf_square({0, 1, 2});
  parts.primitive()["attributes"]["NORMAL"] = parts.add_values(std::vector<glm::vec3>(3), kFloat, "VEC3", 1);
  EXPECT_THAT(refusal(parts), HasSubstr("has 3 elements, but meshes[0].primitives[0].attributes.NORMAL needs 4"));
}

// ---- morph targets ----

// Target 0 moves the upper corners to z = 3, sparse; target 1 moves all by x = 10, in bytes.
GltfBuilder morphed_cube() {
  GltfBuilder parts = gltf_cube();
  const std::vector<glm::vec3> up(4, glm::vec3(0, 0, 2));
  const std::size_t indices = parts.add_view(bytes_of(std::vector<std::uint8_t>{4, 5, 6, 7}));
  const std::size_t values = parts.add_view(bytes_of(up));
  parts.document["accessors"].push_back({{"componentType", kFloat},
                                         {"count", 8},
                                         {"type", "VEC3"},
                                         {"sparse",
                                          {{"count", 4},
                                           {"indices", {{"bufferView", indices}, {"componentType", kUint8}}},
                                           {"values", {{"bufferView", values}}}}}});
  std::vector<std::int8_t> along;
  for (int i = 0; i < 8; ++i) along.insert(along.end(), {10, 0, 0});
  const std::size_t second = parts.add_values(along, kInt8, "VEC3", 3);
  parts.primitive()["targets"] = {{{"POSITION", 2}}, {{"POSITION", second}}};
  return parts;
}

TEST(GltfMorph, TargetsAreAddedByWeight) {
  GltfBuilder parts = morphed_cube();
  expect_box(read(parts), {0, 0, 0}, {1, 1, 1});
  parts.document["meshes"][0]["weights"] = {0.5, 0};
  expect_box(read(parts), {0, 0, 0}, {1, 1, 2});
  parts.document["meshes"][0]["weights"] = {1, 2};
  expect_box(read(parts), {20, 0, 0}, {21, 1, 3});
}

TEST(GltfMorph, WeightsOfTheNodeGoFirst) {
  GltfBuilder parts = morphed_cube();
  parts.document["meshes"][0]["weights"] = {1, 0};
  parts.node(0)["weights"] = {0, 1};
  parts.document["nodes"].push_back({{"mesh", 0}});
  expect_box(read(parts), {10, 0, 0}, {11, 1, 1});
  parts.document["scenes"][0]["nodes"] = {0, 1};
  expect_box(read(parts), {0, 0, 0}, {11, 1, 3});
}

TEST(GltfMorph, TargetsMoveNormals) {
  GltfBuilder parts = gltf_square({0, 1, 2});
  parts.primitive()["attributes"]["NORMAL"] = parts.add_values(std::vector<glm::vec3>(4, {0, 0, 1}), kFloat, "VEC3", 1);
  const std::size_t turn = parts.add_values(std::vector<glm::vec3>(4, {1, 0, -1}), kFloat, "VEC3", 1);
  parts.primitive()["targets"] = {{{"NORMAL", turn}}};
  parts.document["meshes"][0]["weights"] = {1};
  EXPECT_EQ(read(parts).normals[0], glm::vec3(1, 0, 0));
}

TEST(GltfMorph, TargetsAreAsLongAsTheMesh) {
  GltfBuilder parts = morphed_cube();
  parts.document["meshes"][0]["weights"] = {1};
  parts.document["accessors"][2]["count"] = 9;
  EXPECT_THAT(refusal(parts), HasSubstr("accessors[2] has 9 elements"));
}

// ---- skins ----

// The lower corners follow joint 0 at (10, 0, 0), the upper ones joint 1 at (0, 20, 0).
GltfBuilder skinned_cube() {
  GltfBuilder parts = gltf_cube();
  std::vector<std::uint8_t> joints, weights;
  for (int i = 0; i < 8; ++i) {
    joints.insert(joints.end(), {static_cast<std::uint8_t>(i / 4), 99, 0, 0});  // 99 weighs nothing
    weights.insert(weights.end(), {255, 0, 0, 0});
  }
  parts.primitive()["attributes"]["JOINTS_0"] = parts.add_values(joints, kUint8, "VEC4", 4);
  const std::size_t weight = parts.add_values(weights, kUint8, "VEC4", 4);
  parts.document["accessors"][weight]["normalized"] = true;
  parts.primitive()["attributes"]["WEIGHTS_0"] = weight;
  parts.document["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {0, 50, 0}}},
                             {{"translation", {10, 0, 0}}},
                             {{"translation", {0, 20, 0}}}};
  parts.document["skins"] = {{{"joints", {1, 2}}}};
  return parts;
}

TEST(GltfSkin, JointsPlaceTheMeshWhereverItsNodeIs) {
  const FileMesh mesh = read(skinned_cube());
  EXPECT_EQ(mesh.positions[2], glm::dvec3(11, 1, 0));
  EXPECT_EQ(mesh.positions[6], glm::dvec3(1, 21, 1));
}

TEST(GltfSkin, InverseBindMatricesComeFirst) {
  GltfBuilder parts = skinned_cube();
  std::vector<float> matrices(32, 0.0f);
  for (std::size_t i = 0; i < 32; i += 16) matrices[i] = matrices[i + 5] = matrices[i + 10] = matrices[i + 15] = 1;
  matrices[12] = -10;  // of joint 0: moves by (-10, 0, 0)
  parts.document["skins"][0]["inverseBindMatrices"] = parts.add_values(matrices, kFloat, "MAT4", 16);
  const FileMesh mesh = read(parts);
  EXPECT_EQ(mesh.positions[2], glm::dvec3(1, 1, 0));
  EXPECT_EQ(mesh.positions[6], glm::dvec3(1, 21, 1));
  parts.document["skins"][0]["joints"] = {1, 2, 1};
  EXPECT_THAT(refusal(parts), HasSubstr("skins[0] has 3 joints, but only 2 inverse bind matrices"));
}

TEST(GltfSkin, AllSetsOfInfluencesCount) {
  GltfBuilder parts = skinned_cube();
  std::vector<std::uint16_t> joints;
  std::vector<float> first, second;
  for (int i = 0; i < 8; ++i) {
    joints.insert(joints.end(), {0, 0, 0, 1});
    first.insert(first.end(), {0.25f, 0, 0, 0});
    second.insert(second.end(), {0, 0, 0, 0.75f});
  }
  const std::size_t joint_accessor = parts.add_values(joints, kUint16, "VEC4", 4);
  parts.primitive()["attributes"]["JOINTS_0"] = joint_accessor;
  parts.primitive()["attributes"]["JOINTS_1"] = joint_accessor;
  parts.primitive()["attributes"]["WEIGHTS_0"] = parts.add_values(first, kFloat, "VEC4", 4);
  parts.primitive()["attributes"]["WEIGHTS_1"] = parts.add_values(second, kFloat, "VEC4", 4);
  expect_box(read(parts), {2.5, 15, 0}, {3.5, 16, 1});
}

TEST(GltfSkin, RoundedWeightsDoNotShrink) {
  GltfBuilder parts = skinned_cube();
  std::vector<std::uint8_t> weights;
  for (int i = 0; i < 8; ++i) weights.insert(weights.end(), {254, 0, 0, 0});
  const std::size_t weight = parts.add_values(weights, kUint8, "VEC4", 4);
  parts.document["accessors"][weight]["normalized"] = true;
  parts.primitive()["attributes"]["WEIGHTS_0"] = weight;
  EXPECT_LT(glm::distance(read(parts).positions[2], glm::dvec3(11, 1, 0)), 1e-12);
}

TEST(GltfSkin, WithoutAWeightTheFirstJointMoves) {
  GltfBuilder parts = skinned_cube();
  parts.primitive()["attributes"]["WEIGHTS_0"] = parts.add_values(std::vector<float>(32), kFloat, "VEC4", 4);
  EXPECT_EQ(read(parts).positions[6], glm::dvec3(1, 21, 1));
}

TEST(GltfSkin, MirroringJointsKeepTheFront) {
  GltfBuilder parts = skinned_cube();
  parts.node(1)["scale"] = parts.node(2)["scale"] = {-1, 1, 1};
  parts.node(2)["translation"] = {10, 0, 0};
  EXPECT_NEAR(volume(read(parts)), 1, 1e-12);
}

TEST(GltfSkin, JointsMayBeHiddenAndOutsideOfTheScene) {
  GltfBuilder parts = skinned_cube();
  parts.node(1)["extensions"]["KHR_node_visibility"]["visible"] = false;
  EXPECT_EQ(read(parts).positions[2], glm::dvec3(11, 1, 0));
}

TEST(GltfSkin, WithoutInfluencesTheNodePlacesTheMesh) {
  GltfBuilder parts = skinned_cube();
  parts.primitive()["attributes"].erase("JOINTS_0");
  expect_box(read(parts), {0, 50, 0}, {1, 51, 1});
}

TEST(GltfSkin, FaultsAreNamed) {
  GltfBuilder parts = skinned_cube();
  parts.document["skins"][0]["joints"] = {1};
  EXPECT_THAT(refusal(parts), HasSubstr("a vertex names joint 1 of the 1 of skins[0]"));
  parts.document["skins"][0]["joints"] = {9};
  EXPECT_THAT(refusal(parts), HasSubstr("skins[0].joints[0] names nodes[9], which does not exist"));
  parts.node(0)["skin"] = 3;
  EXPECT_THAT(refusal(parts), HasSubstr("nodes[0].skin names skins[3], which does not exist"));
}

}  // namespace
}  // namespace lkao::scene
