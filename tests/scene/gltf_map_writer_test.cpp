// Maps of occlusion in a glTF file's materials.
#include "scene/gltf_writing.h"

namespace lkao::scene {
namespace {

using nlohmann::json;

class GltfMapWriter : public GltfWriter {};

TEST_F(GltfMapWriter, AMapGoesIntoTheMaterial) {
  GltfBuilder parts = cube_with_uvs();
  parts.primitive()["material"] = 0;
  parts.document["materials"] = json::array({{{"name", "red"}, {"doubleSided", true}}});
  put(parts);
  const GltfOutput output = add_maps({{.material = 0, .png = "PNG bytes"}});
  json document = document_of(output.bytes);
  EXPECT_EQ(document["materials"][0]["occlusionTexture"], (json{{"index", 0}}));
  EXPECT_EQ(document["textures"][0], (json{{"sampler", 0}, {"source", 0}}));
  EXPECT_EQ(document["samplers"][0],
            (json{{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", 10497}, {"wrapT", 10497}}));
  EXPECT_EQ(document["images"][0], (json{{"bufferView", 3}, {"mimeType", "image/png"}, {"name", "occlusion of red"}}));
  const json view = document["bufferViews"][3];
  EXPECT_EQ(binary_of(output.bytes).substr(view["byteOffset"], view["byteLength"]), "PNG bytes");

  for (const char* list : {"textures", "samplers", "images"}) document.erase(list);
  document["materials"][0].erase("occlusionTexture");
  document["bufferViews"].erase(3);
  document["buffers"][0]["byteLength"] = parts.buffer.size();
  EXPECT_EQ(document, parts.document);
}

TEST_F(GltfMapWriter, AMapTakesThePlaceOfAnother) {
  GltfBuilder parts = cube_with_uvs();
  parts.primitive()["material"] = 0;
  parts.document["images"] = {{{"uri", "orm.png"}}};
  parts.document["samplers"] = {{{"wrapS", 33071}}};
  parts.document["textures"] = {{{"source", 0}, {"sampler", 0}}};
  parts.document["materials"] = {
      {{"pbrMetallicRoughness", {{"metallicRoughnessTexture", {{"index", 0}}}}},
       {"occlusionTexture",
        {{"index", 0},
         {"strength", 0.5},
         {"extras", {1, 2}},
         {"extensions", {{"KHR_texture_transform", {{"offset", {0.1, 0.2}}}}, {"OTHER", {{"a", 1}}}}}}}}};
  put(parts);
  const json document = document_of(add_maps({{.material = 0, .png = "PNG"}}).bytes);
  json expected = parts.document["materials"][0]["occlusionTexture"];
  expected["index"] = 1;
  EXPECT_EQ(document["materials"][0]["occlusionTexture"], expected);
  EXPECT_EQ(document["materials"][0]["pbrMetallicRoughness"]["metallicRoughnessTexture"], (json{{"index", 0}}));
  EXPECT_EQ(document["textures"][1], (json{{"sampler", 1}, {"source", 1}}));
  EXPECT_EQ(document["samplers"][1]["wrapS"], 33071);
  EXPECT_EQ(document["samplers"][1]["wrapT"], 10497);
  // For another set the old place says nothing.
  const json other = document_of(add_maps({{.material = 0, .png = "PNG"}}, 1).bytes);
  expected["texCoord"] = 1;
  expected["extensions"].erase("KHR_texture_transform");
  EXPECT_EQ(other["materials"][0]["occlusionTexture"], expected);
}

// A material with one image for occlusion, roughness and metal.
GltfBuilder packed_cube() {
  GltfBuilder parts = cube_with_uvs();
  parts.primitive()["material"] = 0;
  const std::size_t view = parts.add_view("\x89PNG and more");
  parts.document["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}}};
  parts.document["textures"] = {{{"source", 0}}};
  parts.document["materials"] = {
      {{"pbrMetallicRoughness", {{"metallicRoughnessTexture", {{"index", 0}}}}}, {"occlusionTexture", {{"index", 0}}}}};
  return parts;
}

TEST_F(GltfMapWriter, APackedImageIsFoundAndReplacedAsAWhole) {
  put(packed_cube());
  const std::optional<PackedImage> image = GltfFile(path_, folder_.path("out.glb")).packed_image(0, 0);
  ASSERT_TRUE(image);
  EXPECT_EQ(image->bytes, "\x89PNG and more");
  EXPECT_EQ(image->name, path_ + ": images[0]");
  const json document = document_of(add_maps({{.material = 0, .png = "PNG", .is_packed = true}}).bytes);
  const json& material = document["materials"][0];
  EXPECT_EQ(material["occlusionTexture"], (json{{"index", 1}}));
  EXPECT_EQ(material["pbrMetallicRoughness"]["metallicRoughnessTexture"], (json{{"index", 1}}));
  EXPECT_EQ(document["textures"][1]["source"], 1);
  EXPECT_EQ(document["images"].size(), 2u);
}

TEST_F(GltfMapWriter, APackedImageIsOneMaterialsAndLiesAlike) {
  const auto is_packed = [&](const GltfBuilder& parts, int uv_set = 0) {
    put(parts);
    return GltfFile(path_, folder_.path("out.glb")).packed_image(0, uv_set).has_value();
  };
  const GltfBuilder packed = packed_cube();
  EXPECT_TRUE(is_packed(packed));
  EXPECT_FALSE(is_packed(packed, 1));
  EXPECT_FALSE(is_packed(cube_with_uvs())) << "there is no material";
  GltfBuilder parts = packed;
  parts.document["materials"][0]["occlusionTexture"]["texCoord"] = 1;
  EXPECT_FALSE(is_packed(parts));
  parts = packed;
  json& looks = parts.document["materials"][0]["pbrMetallicRoughness"];
  looks["metallicRoughnessTexture"]["extensions"]["KHR_texture_transform"] = {{"scale", {2, 2}}};
  EXPECT_FALSE(is_packed(parts));
  parts.document["materials"][0]["occlusionTexture"]["extensions"]["KHR_texture_transform"] = {{"scale", {2, 2}}};
  EXPECT_TRUE(is_packed(parts));
  parts = packed;
  parts.document["materials"].push_back({{"emissiveTexture", {{"index", 0}}}});
  EXPECT_FALSE(is_packed(parts)) << "another material has it too";
  parts = packed;
  parts.document["images"][0] = {{"uri", "is not there.png"}};
  EXPECT_FALSE(is_packed(parts));
}

TEST_F(GltfMapWriter, PrimitivesWithoutCoordinatesKeepTheirMaterial) {
  GltfBuilder parts = cube_with_uvs();
  parts.primitive()["material"] = 0;
  json bare = parts.primitive();
  bare["attributes"].erase("TEXCOORD_0");
  parts.document["meshes"][0]["primitives"].push_back(bare);
  parts.document["materials"] = json::array({{{"name", "red"}}});
  put(parts);
  const json document = document_of(add_maps({{.material = 0, .png = "PNG"}}).bytes);
  EXPECT_EQ(primitive_of(document, 0, 0)["material"], 0);
  EXPECT_EQ(primitive_of(document, 0, 1)["material"], 1);
  EXPECT_TRUE(document["materials"][0].contains("occlusionTexture"));
  EXPECT_EQ(document["materials"][1], parts.document["materials"][0]);
}

TEST_F(GltfMapWriter, WhatHasNoMaterialGetsOne) {
  GltfBuilder parts = cube_with_uvs();
  put(parts);
  const json document = document_of(add_maps({{.png = "PNG"}}).bytes);
  EXPECT_EQ(primitive_of(document, 0)["material"], 0);
  EXPECT_EQ(document["materials"], (json::array({{{"occlusionTexture", {{"index", 0}}}}})));
}

TEST_F(GltfMapWriter, ImagesLieBesideAText) {
  GltfBuilder parts = cube_with_uvs();
  parts.primitive()["material"] = 1;
  parts.document["materials"] = {json::object(), json::object()};
  put(parts, "in.gltf");
  const GltfFile file(path_, folder_.path("out.gltf"));
  const GltfOutput one = file.with_maps(std::vector<OcclusionMap>{{.material = 1, .png = "PNG"}}, 0);
  ASSERT_EQ(one.beside.size(), 1u);
  EXPECT_EQ(one.beside[0].name, "out.occlusion.png");
  EXPECT_EQ(one.beside[0].bytes, "PNG");
  EXPECT_EQ(json::parse(one.bytes)["images"][0]["uri"], "out.occlusion.png");
  EXPECT_EQ(json::parse(one.bytes)["buffers"].size(), 1u);
  const GltfOutput two =
      file.with_maps(std::vector<OcclusionMap>{{.material = 1, .png = "B"}, {.material = 0, .png = "A"}}, 0);
  ASSERT_EQ(two.beside.size(), 2u);
  EXPECT_EQ(two.beside[0].name, "out.occlusion-1.png");
  EXPECT_EQ(two.beside[1].name, "out.occlusion-0.png");
  EXPECT_EQ(json::parse(two.bytes)["samplers"].size(), 1u) << "one for all that wrap alike";
}

}  // namespace
}  // namespace lkao::scene
