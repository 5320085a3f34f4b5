// Texture coordinates, materials and the sources of vertices, out of glTF.
#include <gmock/gmock.h>

#include "scene/files.h"
#include "scene/gltf_packing.h"
#include "scene/gltf_reading.h"
#include "scene/mesh.h"

namespace lkao::scene {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

FileMesh read_uvs(const GltfBuilder& builder, int uv_set = 0) {
  return read_gltf("", builder.gltf(), {.uv_set = uv_set});
}

// The square with these texture coordinates of vertices, its triangles (0, 1, 2) and (0, 2, 3), and a material.
template <typename Number>
GltfBuilder textured_square(const std::vector<Number>& uvs, int component_type, bool is_normalized = false) {
  GltfBuilder parts = gltf_square({0, 1, 2, 0, 2, 3});
  const std::size_t accessor = parts.add_values(uvs, component_type, "VEC2", 2);
  if (is_normalized) parts.document["accessors"][accessor]["normalized"] = true;
  parts.primitive()["attributes"]["TEXCOORD_0"] = accessor;
  parts.primitive()["material"] = 0;
  parts.document["materials"] = json::array({json::object()});
  return parts;
}
GltfBuilder textured_square() { return textured_square(std::vector<float>{0, 1, 1, 1, 1, 0, 0, 0}, kFloat); }

glm::vec2 uv_of(const FileMesh& mesh, std::size_t triangle, int corner) {
  return mesh.uvs.at(mesh.uv_corners.at(triangle)[corner]);
}

TEST(GltfUvs, StandAsTheFileHasThem) {
  const FileMesh mesh = read_uvs(textured_square());
  EXPECT_THAT(mesh.uvs, ElementsAre(glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0), glm::vec2(0, 0)));
  EXPECT_THAT(mesh.uv_corners, ElementsAre(glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)));
  EXPECT_THAT(mesh.materials, ElementsAre(0u, 0u));
  EXPECT_THAT(mesh.contents.materials, ElementsAre(""));
  const FileMesh plain = read(textured_square());
  EXPECT_TRUE(plain.uvs.empty() && plain.uv_corners.empty() && plain.materials.empty());
  EXPECT_TRUE(plain.contents.materials.empty() && plain.contents.wraps.empty());
}

TEST(GltfUvs, SetsAreToldApart) {
  GltfBuilder parts = textured_square();
  parts.primitive()["attributes"]["TEXCOORD_1"] =
      parts.add_values(std::vector<float>{5, 5, 6, 6, 7, 7, 8, 8}, kFloat, "VEC2", 2);
  EXPECT_EQ(uv_of(read_uvs(parts, 1), 1, 1), glm::vec2(7, 7));
  EXPECT_TRUE(read_uvs(parts, 2).uvs.empty());
  EXPECT_THAT(read_uvs(parts, 2).uv_corners, ElementsAre(glm::uvec3(kNoUv), glm::uvec3(kNoUv)));
}

TEST(GltfUvs, MayBeNormalizedIntegers) {
  const std::vector<std::uint8_t> bytes = {0, 255, 51, 0, 0, 0, 0, 0};
  EXPECT_EQ(uv_of(read_uvs(textured_square(bytes, kUint8, true)), 0, 1), glm::vec2(0.2f, 0));
  const std::vector<std::uint16_t> shorts = {0, 65535, 13107, 0, 0, 0, 0, 0};
  EXPECT_EQ(uv_of(read_uvs(textured_square(shorts, kUint16, true)), 0, 1), glm::vec2(0.2f, 0));
}

TEST(GltfUvs, PlainIntegersAreTransformedAsTheTexturesAre) {
  GltfBuilder parts = textured_square(std::vector<std::uint16_t>{0, 0, 4, 8, 0, 0, 0, 0}, kUint16);
  EXPECT_EQ(uv_of(read_uvs(parts), 0, 1), glm::vec2(4, 8));
  parts.document["materials"][0]["normalTexture"] = {
      {"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {0.125, 0.0625}}, {"offset", {1, 2}}}}}}};
  parts.document["textures"] = json::array({json::object()});
  EXPECT_EQ(uv_of(read_uvs(parts), 0, 1), glm::vec2(1.5f, 2.5f));
  EXPECT_EQ(uv_of(read_uvs(parts), 1, 0), glm::vec2(1, 2));
}

TEST(GltfUvs, AreTransformedAsTheMapOfOcclusionAlone) {
  GltfBuilder parts = textured_square();
  parts.document["textures"] = json::array({json::object()});
  const json moved = {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}}}}}};
  parts.document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = moved;
  EXPECT_EQ(uv_of(read_uvs(parts), 0, 0), glm::vec2(0, 1)) << "colours may be tiled, which occlusion may not";
  parts.document["materials"][0]["occlusionTexture"] = moved;
  EXPECT_EQ(uv_of(read_uvs(parts), 0, 0), glm::vec2(0.5f, 1));
  json& transform = parts.document["materials"][0]["occlusionTexture"]["extensions"]["KHR_texture_transform"];
  transform = {{"rotation", 1.5707963267948966}, {"scale", {2, 3}}};
  // Counterclockwise, as v points down: (1, 0) goes up, (0, 1) to the right.
  EXPECT_NEAR(uv_of(read_uvs(parts), 0, 0).x, 3, 1e-6);
  EXPECT_NEAR(uv_of(read_uvs(parts), 0, 0).y, 0, 1e-6);
  EXPECT_NEAR(uv_of(read_uvs(parts), 0, 2).y, -2, 1e-6);
  transform = {{"offset", {9, 9}}, {"texCoord", 1}};
  EXPECT_EQ(uv_of(read_uvs(parts), 0, 0), glm::vec2(0, 1)) << "that map is for another set";
}

TEST(GltfUvs, InstancesShareThemAndMirroredOnesTurnThemRound) {
  GltfBuilder parts = textured_square();
  parts.document["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"scale", {-1, 1, 1}}}};
  parts.document["scenes"][0]["nodes"] = {0, 1};
  const FileMesh mesh = read_uvs(parts);
  ASSERT_EQ(mesh.triangles.size(), 4u);
  for (std::size_t t = 0; t < 4; ++t) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t vertex = mesh.triangles[t][i] % 4;
      EXPECT_EQ(uv_of(mesh, t, i), mesh.uvs[vertex]) << t << ", " << i;
    }
  }
  EXPECT_EQ(mesh.triangles[2], glm::uvec3(4, 6, 5));
}

TEST(GltfUvs, OfPackedPrimitivesAreRead) {
  GltfBuilder parts = textured_square();
  const std::vector<float> uvs = {0, 1, 1, 1, 1, 0, 0, 0};
  pack_view(parts, 2, pack_vertices(bytes_of(uvs), 8), 4, 8, "ATTRIBUTES");
  parts.document["buffers"].push_back({{"byteLength", 1000}});
  EXPECT_EQ(uv_of(read_uvs(parts), 0, 1), glm::vec2(1, 1));
  GltfBuilder draco = draco_cube();
  draco.primitive()["attributes"]["TEXCOORD_0"] = 3;  // of vertices in Draco's order, beside it
  const std::size_t count = read(draco).positions.size();
  std::vector<float> beside(2 * count);
  for (std::size_t i = 0; i < count; ++i) beside[2 * i] = static_cast<float>(i);
  ASSERT_EQ(draco.add_values(beside, kFloat, "VEC2", 2), 3u);
  const FileMesh mesh = read_uvs(draco);
  EXPECT_EQ(uv_of(mesh, 5, 2), glm::vec2(mesh.triangles[5].z, 0));
}

TEST(GltfUvs, OfAnotherNumberThanVerticesAreAFault) {
  GltfBuilder parts = textured_square(std::vector<float>{0, 1, 1, 1, 1, 0}, kFloat);
  const auto fault_of = [](const GltfBuilder& builder) -> std::string {
    try {
      read_uvs(builder);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(fault_of(parts), HasSubstr("accessors[2] has 3 elements"));
  EXPECT_EQ(read(parts).triangles.size(), 2u) << "it was not asked for";
  parts.document["accessors"][2]["count"] = 4;
  parts.document["accessors"][2]["type"] = "VEC3";
  EXPECT_THAT(fault_of(parts), HasSubstr("accessors[2] is \"VEC3\""));
}

TEST(GltfUvs, MaterialsAreTheFilesOwn) {
  GltfBuilder parts = textured_square();
  json second = parts.primitive();
  second.erase("material");
  parts.document["meshes"][0]["primitives"].push_back(second);
  parts.document["materials"] = {{{"name", "not used"}}, {{"name", "two\nlines"}}};
  parts.primitive()["material"] = 1;
  const FileMesh mesh = read_uvs(parts);
  EXPECT_THAT(mesh.contents.materials, ElementsAre("not used", "two lines"));
  EXPECT_THAT(mesh.materials, ElementsAre(1u, 1u, kNoMaterial, kNoMaterial));
}

TEST(GltfUvs, WrapsAreThoseOfTheTexturesOfTheSet) {
  GltfBuilder parts = textured_square();
  parts.document["samplers"] = {{{"wrapS", 33648}}, {{"wrapS", 33071}, {"wrapT", 33071}}};
  parts.document["textures"] = {{{"sampler", 0}}, {{"sampler", 1}}, json::object()};
  json& material = parts.document["materials"][0];
  EXPECT_THAT(read_uvs(parts).contents.wraps, ElementsAre(TextureWraps{}));
  material["normalTexture"] = {{"index", 0}};
  EXPECT_THAT(read_uvs(parts).contents.wraps, ElementsAre(TextureWraps{TextureWrap::mirror, TextureWrap::repeat}));
  material["occlusionTexture"] = {{"index", 1}, {"texCoord", 1}};
  EXPECT_THAT(read_uvs(parts).contents.wraps, ElementsAre(TextureWraps{TextureWrap::mirror, TextureWrap::repeat}));
  EXPECT_THAT(read_uvs(parts, 1).contents.wraps, ElementsAre(TextureWraps{TextureWrap::clamp, TextureWrap::clamp}));
  material["occlusionTexture"] = {{"index", 2}};
  EXPECT_THAT(read_uvs(parts).contents.wraps, ElementsAre(TextureWraps{}));
}

TEST(GltfBlocks, SayWhereVerticesComeFrom) {
  GltfBuilder parts = textured_square();
  json apart = parts.primitive();
  apart["attributes"]["POSITION"] =
      parts.add_values(std::vector<glm::vec3>{{5, 0, 0}, {6, 0, 0}, {6, 1, 0}}, kFloat, "VEC3", 1);
  apart["attributes"].erase("TEXCOORD_0");
  apart.erase("indices");
  json lines = parts.primitive();
  lines["mode"] = 1;
  const json same = parts.primitive();
  parts.document["meshes"][0]["primitives"].push_back(lines);
  parts.document["meshes"][0]["primitives"].push_back(apart);
  parts.document["meshes"][0]["primitives"].push_back(same);
  parts.document["nodes"] = {{{"translation", {0, 0, 1}}}, {{"mesh", 0}}, {{"mesh", 0}}};
  parts.node(2)["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
      parts.add_values(std::vector<glm::vec3>{{0, 0, 5}, {0, 0, 6}}, kFloat, "VEC3", 1);
  parts.document["scenes"][0]["nodes"] = {0, 2, 1};
  const FileMesh mesh = read(parts);
  const std::vector<VertexBlock>& blocks = mesh.contents.vertex_blocks;
  ASSERT_EQ(blocks.size(), 6u);
  std::size_t next = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(blocks[i].node, i < 4 ? 2u : 1u);
    EXPECT_EQ(blocks[i].instance, i / 2 == 1 ? 1u : 0u);
    EXPECT_EQ(blocks[i].mesh, 0u);
    EXPECT_EQ(blocks[i].primitives, i % 2 == 0 ? (std::vector<std::uint32_t>{0, 3}) : std::vector<std::uint32_t>{2});
    EXPECT_EQ(blocks[i].first_vertex, next);
    EXPECT_EQ(blocks[i].vertex_count, i % 2 == 0 ? 4u : 3u);
    next += blocks[i].vertex_count;
  }
  EXPECT_EQ(next, mesh.positions.size());
  EXPECT_EQ(mesh.positions[blocks[3].first_vertex], glm::dvec3(5, 0, 6));
}

}  // namespace
}  // namespace lkao::scene
