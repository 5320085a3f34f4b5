// Holes by transparency: alphaMode of glTF.
#include <gmock/gmock.h>

#include "alpha_files.h"
#include "files.h"
#include "gltf_reading.h"
#include "scene/mesh_file.h"

namespace lkao::scene {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kHalfClear = alpha_file(2, 1, std::string("\0\xff", 2));

GltfBuilder leaf(const std::string& image = kHalfClear) { return gltf_leaf(image); }

json& material_of(GltfBuilder& parts) { return parts.document["materials"][0]; }
json& texture_of(GltfBuilder& parts) { return material_of(parts)["pbrMetallicRoughness"]["baseColorTexture"]; }

FileMesh read_with_holes(const GltfBuilder& parts, const std::string& path = "") {
  return read_gltf(path, parts.gltf(), {.decode_alpha = decode_alpha_file});
}

const HoleMaterial& material_of(const FileMesh& mesh) { return mesh.holes->materials.at(0); }

TEST(GltfHoles, AreReadOnRequestAlone) {
  EXPECT_EQ(read(leaf()).holes, nullptr);
  EXPECT_THAT(read(leaf()).contents.remarks, ElementsAre(HasSubstr("block as if whole")));
  const FileMesh mesh = read_with_holes(leaf());
  ASSERT_NE(mesh.holes, nullptr);
  EXPECT_EQ(mesh.contents.cut_out_count, 2u);
  EXPECT_THAT(mesh.contents.remarks, IsEmpty());
  EXPECT_EQ(material_of(mesh).cut_off, 0.5);
  EXPECT_EQ(material_of(mesh).factor, 1);
  EXPECT_FALSE(material_of(mesh).texture->is_smooth);
  EXPECT_EQ(material_of(mesh).texture->image->alphas, (std::vector<std::uint16_t>{0, 65535}));
  // The left half is clear: x = u + v in the first triangle.
  EXPECT_EQ(mesh.holes->alpha(0, {0.4, 0.05}), 0);
  EXPECT_EQ(mesh.holes->alpha(0, {0.4, 0.15}), 1);
}

TEST(GltfHoles, ObeyMaterialAndSampler) {
  GltfBuilder parts = leaf();
  material_of(parts)["alphaCutoff"] = 0.25;
  material_of(parts)["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.75};
  parts.document["samplers"][0] = {{"wrapS", 33071}, {"wrapT", 33648}};
  const FileMesh mesh = read_with_holes(parts);
  EXPECT_EQ(material_of(mesh).cut_off, 0.25);
  EXPECT_EQ(material_of(mesh).factor, 0.75);
  EXPECT_EQ(material_of(mesh).texture->wraps, (TextureWraps{TextureWrap::clamp, TextureWrap::mirror}));
  EXPECT_TRUE(material_of(mesh).texture->is_smooth);
}

TEST(GltfHoles, LieWhereTheTextureDoes) {
  GltfBuilder parts = leaf();
  parts.primitive()["attributes"]["TEXCOORD_1"] =
      parts.add_values(std::vector<float>{0, 0.5f, 1, 0.5f, 1, 0, 0, 0}, kFloat, "VEC2", 2);
  texture_of(parts)["texCoord"] = 1;
  EXPECT_EQ(read_with_holes(parts).holes->triangles[0].uvs[0], glm::vec2(0, 0.5f));
  texture_of(parts)["extensions"]["KHR_texture_transform"] = {{"offset", {0.25, 0}}, {"scale", {2, 4}}};
  EXPECT_EQ(read_with_holes(parts).holes->triangles[0].uvs[1], glm::vec2(2.25f, 2));
  texture_of(parts)["extensions"]["KHR_texture_transform"]["texCoord"] = 0;
  EXPECT_EQ(read_with_holes(parts).holes->triangles[0].uvs[1], glm::vec2(2.25f, 4));
  // None are zero, as in viewers.
  texture_of(parts) = {{"index", 0}, {"texCoord", 2}};
  EXPECT_EQ(read_with_holes(parts).holes->triangles[0].uvs[1], glm::vec2(0));
}

TEST(GltfHoles, StayWithMirroredAndRepeatedNodes) {
  GltfBuilder parts = leaf();
  parts.document["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"scale", {-1, 1, 1}}}};
  parts.document["scenes"][0]["nodes"] = {0, 1};
  const FileMesh mesh = read_with_holes(parts);
  ASSERT_EQ(mesh.holes->numbers.size(), 4u);
  EXPECT_EQ(mesh.contents.cut_out_count, 4u);
  for (std::size_t t = 0; t < 4; ++t) {
    const HoleTriangle& holes = mesh.holes->triangles[mesh.holes->numbers[t]];
    const std::vector<glm::dvec3> p = corners(mesh, t);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(holes.uvs[i], glm::vec2(std::abs(p[i].x), 1 - p[i].y)) << t << ", " << i;
    }
  }
}

TEST(GltfHoles, CountColoursOfVertices) {
  GltfBuilder parts = leaf();
  json& colours = parts.primitive()["attributes"]["COLOR_0"];
  const std::vector<float> floats{1, 1, 1, 0.5f, 1, 1, 1, 1, 1, 1, 1, 0.25f, 1, 1, 1, 1};
  colours = parts.add_values(floats, kFloat, "VEC4", 4);
  EXPECT_EQ(read_with_holes(parts).holes->triangles[0].alphas, (std::array<float, 3>{0.5f, 1, 0.25f}));
  const std::vector<std::uint8_t> bytes{9, 9, 9, 51, 9, 9, 9, 255, 9, 9, 9, 0, 9, 9, 9, 255};
  colours = parts.add_values(bytes, kUint8, "VEC4", 4);
  parts.document["accessors"].back()["normalized"] = true;
  EXPECT_EQ(read_with_holes(parts).holes->triangles[0].alphas, (std::array<float, 3>{0.2f, 1, 0}));
  colours = parts.add_values(std::vector<glm::vec3>(4), kFloat, "VEC3", 1);
  EXPECT_EQ(read_with_holes(parts).holes->triangles[0].alphas, (std::array<float, 3>{1, 1, 1}));
  // Holes of colours alone.
  material_of(parts).erase("pbrMetallicRoughness");
  EXPECT_EQ(read_with_holes(parts).holes, nullptr);
  colours = parts.add_values(floats, kFloat, "VEC4", 4);
  EXPECT_EQ(read_with_holes(parts).holes->alpha(0, {1, 0}), 1);
  EXPECT_EQ(read_with_holes(parts).holes->alpha(0, {0, 1}), 0.25);
}

TEST(GltfHoles, AreNoneWhereNothingIsMissing) {
  const FileMesh mesh = read_with_holes(leaf(alpha_file(2, 1, "\x80\xff")));
  EXPECT_EQ(mesh.holes, nullptr);
  EXPECT_EQ(mesh.contents.cut_out_count, 0u);
  EXPECT_THAT(mesh.contents.remarks, IsEmpty());
  GltfBuilder opaque = leaf();
  material_of(opaque)["alphaMode"] = "OPAQUE";
  EXPECT_EQ(read_with_holes(opaque).holes, nullptr);
}

TEST(GltfHoles, AreOfThoseTrianglesAloneThatShowSome) {
  // 16 columns, of which one is clear.
  std::string alphas(16, '\xff');
  alphas[12] = 0;
  GltfBuilder parts = leaf(alpha_file(16, 1, alphas));
  // The first triangle shows columns 0 to 8, the second all of them.
  json& uvs = parts.primitive()["attributes"]["TEXCOORD_0"];
  uvs = parts.add_values(std::vector<float>{0, 1, 0.5f, 1, 0.5f, 0, 1, 0}, kFloat, "VEC2", 2);
  EXPECT_EQ(read_with_holes(parts).holes->numbers, (std::vector<std::uint32_t>{kWhole, 0}));
  EXPECT_EQ(read_with_holes(parts).contents.cut_out_count, 1u);
  // Repeated, both show it; clamped, neither.
  uvs = parts.add_values(std::vector<float>{-0.4f, 0, 0, 0, 0, 1, -0.4f, 1}, kFloat, "VEC2", 2);
  EXPECT_EQ(read_with_holes(parts).contents.cut_out_count, 2u);
  parts.document["samplers"][0]["wrapS"] = 33071;
  EXPECT_EQ(read_with_holes(parts).holes, nullptr);
  // So far away that texels are not told apart.
  uvs = parts.add_values(std::vector<float>(8, 1e20f), kFloat, "VEC2", 2);
  EXPECT_EQ(read_with_holes(parts).contents.cut_out_count, 2u);
  // A neighbour that a smooth image mixes in.
  uvs = parts.add_values(std::vector<float>{0.7f, 0, 0.74f, 0, 0.74f, 1, 0.7f, 1}, kFloat, "VEC2", 2);
  parts.document["samplers"][0].erase("magFilter");
  EXPECT_EQ(read_with_holes(parts).contents.cut_out_count, 2u);
}

TEST(GltfHoles, OfBlendingAreRemarkedOn) {
  GltfBuilder parts = leaf(alpha_file(2, 1, "\x80\xff"));
  material_of(parts)["alphaMode"] = "BLEND";
  const FileMesh mesh = read_with_holes(parts);
  EXPECT_FALSE(material_of(mesh).cut_off.has_value());
  EXPECT_THAT(mesh.contents.remarks,
              ElementsAre("material \"leaf\" is half-transparent: its 2 triangles block each ray "
                          "with the probability of their alpha"));
}

TEST(GltfHoles, TakeOtherKindsOfTexturesAndMaterials) {
  GltfBuilder parts = leaf();
  parts.document["textures"][0] = {{"sampler", 0}, {"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}};
  EXPECT_EQ(read_with_holes(parts).holes->alpha(0, {0.4, 0.05}), 0);
  const json texture = texture_of(parts);
  material_of(parts).erase("pbrMetallicRoughness");
  material_of(parts)["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {{"diffuseFactor", {1, 1, 1, 0.75}},
                                                                             {"diffuseTexture", texture}};
  EXPECT_EQ(read_with_holes(parts).holes->alpha(0, {0.4, 0.05}), 0);
  EXPECT_EQ(read_with_holes(parts).holes->alpha(0, {0.4, 0.15}), 0.75);
}

TEST(GltfHoles, OfImagesThatCannotBeReadAreSaid) {
  GltfBuilder parts = leaf("?");
  EXPECT_THAT(read_with_holes(parts).contents.remarks,
              ElementsAre("cannot read 'images[0]': it is short: it counts as opaque, in material \"leaf\""));
  EXPECT_EQ(read_with_holes(parts).holes, nullptr);
  material_of(parts)["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.25};
  EXPECT_EQ(read_with_holes(parts).holes->alpha(0, {0.4, 0.05}), 0.25);
  EXPECT_THAT(read_with_holes(leaf(alpha_file(0, 0, ""))).contents.remarks, ElementsAre(HasSubstr("has no pixels")));
  parts.document["images"][0] = {{"uri", "no/such.png"}};
  EXPECT_THAT(read_with_holes(parts).contents.remarks, ElementsAre(HasSubstr("cannot read 'no/such.png': ")));
  parts.document["images"][0] = {{"bufferView", 99}};
  EXPECT_THAT(read_with_holes(parts).contents.remarks, ElementsAre(HasSubstr("cannot read 'images[0]': ")));
  // Many make few lines.
  const json primitive = parts.primitive();
  for (int i = 1; i < 9; ++i) {
    parts.document["images"].push_back({{"uri", "no/such.png"}});
    parts.document["textures"].push_back({{"source", i}});
    parts.document["materials"].push_back(material_of(parts));
    parts.document["materials"].back()["pbrMetallicRoughness"]["baseColorTexture"]["index"] = i;
    parts.document["meshes"][0]["primitives"].push_back(primitive);
    parts.document["meshes"][0]["primitives"].back()["material"] = i;
  }
  EXPECT_THAT(read_with_holes(parts).contents.remarks,
              ElementsAre(HasSubstr("images[0]"), HasSubstr("such.png"), HasSubstr("such.png"),
                          "6 more images cannot be read, and count as opaque"));
}

TEST(GltfHoles, OfImagesBesideAndWithinAreTheSame) {
  const TemporaryFolder folder;
  GltfBuilder parts = leaf();
  folder.write("a leaf.png", kHalfClear);
  for (const std::string& uri : {std::string("a%20leaf.png"), "data:image/png;base64," + to_base64(kHalfClear)}) {
    parts.document["images"][0] = {{"uri", uri}};
    const std::string path = folder.write("leaf.gltf", parts.gltf());
    const Mesh mesh = read_mesh_file(path, {.decode_alpha = decode_alpha_file});
    ASSERT_NE(mesh.holes, nullptr) << uri;
    EXPECT_EQ(mesh.holes->alpha(0, {0.4, 0.05}), 0);
  }
}

TEST(GltfHoles, OfWrongDocumentsAreRefused) {
  const auto refused = [](const char* pointer, const json& value) -> std::string {
    GltfBuilder parts = leaf();
    parts.document[json::json_pointer(pointer)] = value;
    try {
      read_with_holes(parts);
      return "";
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  };
  EXPECT_THAT(refused("/materials/0/alphaCutoff", "half"), HasSubstr("materials[0].alphaCutoff is \"half\""));
  EXPECT_THAT(refused("/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 1}), HasSubstr("2 numbers, not 4"));
  EXPECT_THAT(refused("/materials/0/pbrMetallicRoughness/baseColorTexture/index", 7), HasSubstr("textures"));
  EXPECT_THAT(refused("/textures/0/source", 7), HasSubstr("images"));
  EXPECT_THAT(refused("/textures/0/sampler", 7), HasSubstr("samplers"));
}

}  // namespace
}  // namespace lkao::scene
