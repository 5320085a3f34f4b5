#include <cmath>
#include <iterator>

#include <gmock/gmock.h>

#include "scene/formats/gltf/load_number.h"
#include "scene/gltf_packing.h"
#include "scene/gltf_writing.h"

namespace lkao::scene {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

// The floats of an accessor of GLB's own buffer.
std::vector<float> floats_of(const std::string& glb, const json& accessor_number) {
  const json document = document_of(glb);
  const std::string binary = binary_of(glb);
  const json& accessor = document["accessors"][accessor_number.get<std::size_t>()];
  const json& view = document["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  const std::size_t width = accessor["type"] == "VEC3" ? 3 : 1;
  EXPECT_EQ(accessor["componentType"], kFloat);
  EXPECT_EQ(view.value("byteStride", 0u), 4 * width);
  EXPECT_EQ(view["target"], 34962);
  EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0u);
  std::vector<float> floats(accessor["count"].get<std::size_t>() * width);
  const std::size_t begin = view["byteOffset"].get<std::size_t>() + accessor["byteOffset"].get<std::size_t>();
  EXPECT_LE(accessor["byteOffset"].get<std::size_t>() + 4 * floats.size(), view["byteLength"].get<std::size_t>());
  for (std::size_t i = 0; i < floats.size(); ++i) floats[i] = gltf::load_number<float>(&binary.at(begin + 4 * i));
  return floats;
}

GltfBuilder cube_at_nodes(std::size_t count) {
  GltfBuilder parts = gltf_cube();
  parts.document["nodes"] = json::array();
  for (std::size_t i = 0; i < count; ++i) {
    parts.document["nodes"].push_back({{"mesh", 0}, {"translation", {2 * i, 0, 0}}});
    parts.document["scenes"][0]["nodes"][i] = i;
  }
  return parts;
}

// ---- vertices ----

TEST_F(GltfWriter, VerticesGetAnAttributeAndAllElseStays) {
  GltfBuilder parts = gltf_cube();
  parts.document["extras"] = {{"note", "kept"}};
  parts.document["animations"] = json::array({{{"name", "none"}}});
  put(parts);
  const std::string before = parts.glb();
  const GltfOutput output = bake();
  EXPECT_TRUE(output.beside.empty() && output.remarks.empty());

  json document = document_of(output.bytes);
  const json number = primitive_of(document, 0)["attributes"]["_OCCLUSION"];
  const std::vector<float> values = floats_of(output.bytes, number);
  ASSERT_EQ(values.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(values[i], static_cast<float>(i) / 8);

  document["meshes"][0]["primitives"][0]["attributes"].erase("_OCCLUSION");
  document["accessors"].erase(2);
  document["bufferViews"].erase(2);
  document["buffers"][0]["byteLength"] = parts.buffer.size();
  EXPECT_EQ(document, parts.document);
  EXPECT_TRUE(binary_of(output.bytes).starts_with(binary_of(before)));
  EXPECT_EQ(document_of(output.bytes)["buffers"][0]["byteLength"], binary_of(output.bytes).size());
  EXPECT_EQ(output.bytes.size() % 4, 0u);
}

TEST_F(GltfWriter, NumbersKeepTheirSpelling) {
  GltfBuilder parts = gltf_cube();
  std::string text = parts.gltf();
  text.replace(text.find("\"scene\":0"), 9, "\"scene\" : 0, \"extras\":[1.50e+0,12345678901234567890123,-0.0]");
  path_ = folder_.write("in.gltf", text);
  contents_ = open_mesh_file(path_).contents;
  const GltfFile file(path_, folder_.path("out.gltf"));
  const GltfOutput output = file.with_vertices(contents_, std::vector<float>(8), GltfAttribute::occlusion);
  EXPECT_THAT(output.bytes, HasSubstr("\"scene\" : 0, \"extras\":[1.50e+0,12345678901234567890123,-0.0]"));
}

TEST_F(GltfWriter, OtherChunksAreKept) {
  const GltfBuilder parts = gltf_cube();
  std::string json_chunk = parts.document.dump();
  json_chunk.resize((json_chunk.size() + 3) / 4 * 4, ' ');
  path_ = folder_.write(
      "in.glb",
      glb_of({{"JSON", json_chunk}, {std::string("BIN\0", 4), parts.buffer}, {"MORE", "abcd"}, {"LAST", "efgh"}}));
  contents_ = open_mesh_file(path_).contents;
  const std::string bytes = bake().bytes;
  EXPECT_TRUE(bytes.ends_with(std::string("\4\0\0\0MOREabcd\4\0\0\0LASTefgh", 24)));
  EXPECT_EQ(gltf::load_number<std::uint32_t>(&bytes[8]), bytes.size());
}

TEST_F(GltfWriter, ColoursAreTheVisibility) {
  put(gltf_cube());
  const std::string bytes = bake({0, 0.25f, 1, 2, -1, NAN, 0, 0}, GltfAttribute::colour).bytes;
  const json attributes = primitive_of(document_of(bytes), 0)["attributes"];
  EXPECT_FALSE(attributes.contains("_OCCLUSION"));
  const std::vector<float> colours = floats_of(bytes, attributes["COLOR_0"]);
  ASSERT_EQ(colours.size(), 24u);
  const float visibilities[] = {1, 0.75f, 0, 0, 1, 1};
  for (std::size_t i = 0; i < std::size(visibilities); ++i) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(colours[3 * i + k], visibilities[i]) << i;
  }
}

TEST_F(GltfWriter, WhatIsNoneIsZero) {
  put(gltf_cube());
  const std::string bytes = bake({NAN, 0.5f, NAN, NAN, NAN, NAN, NAN, NAN}).bytes;
  EXPECT_THAT(floats_of(bytes, 2), ElementsAre(0, 0.5f, 0, 0, 0, 0, 0, 0));
}

TEST_F(GltfWriter, NodesThatShowOneMeshDifferentlyGetCopies) {
  GltfBuilder parts = cube_at_nodes(4);
  parts.document["meshes"][0]["name"] = "cube";
  put(parts);
  std::vector<float> values(32);
  for (std::size_t i = 0; i < 32; ++i) values[i] = i / 8 == 0 || i / 8 == 2 ? 0.25f : static_cast<float>(i / 8) / 8;
  const std::string bytes = bake(values).bytes;
  const json document = document_of(bytes);
  ASSERT_EQ(document["meshes"].size(), 3u);
  EXPECT_EQ(document["nodes"][0]["mesh"], 0);
  EXPECT_EQ(document["nodes"][1]["mesh"], 1);
  EXPECT_EQ(document["nodes"][2]["mesh"], 0);
  EXPECT_EQ(document["nodes"][3]["mesh"], 2);
  for (std::size_t m = 0; m < 3; ++m) {
    EXPECT_EQ(document["meshes"][m]["name"], "cube");
    EXPECT_EQ(primitive_of(document, m)["attributes"]["POSITION"], 0);
    EXPECT_EQ(primitive_of(document, m)["indices"], 1);
    const json number = primitive_of(document, m)["attributes"]["_OCCLUSION"];
    EXPECT_EQ(floats_of(bytes, number), std::vector<float>(8, values[m == 0 ? 0 : m == 1 ? 8 : 24]));
  }
  // It is read as it was, and written again: nothing is doubled a second time.
  path_ = folder_.write("again.glb", bytes);
  contents_ = open_mesh_file(path_).contents;
  EXPECT_EQ(document_of(bake(values).bytes)["meshes"].size(), 3u);
}

TEST_F(GltfWriter, PrimitivesOfSharedVerticesShareTheValues) {
  GltfBuilder parts = gltf_cube();
  parts.document["meshes"][0]["primitives"].push_back(parts.primitive());
  json lines = parts.primitive();
  lines["mode"] = 1;
  parts.document["meshes"][0]["primitives"].push_back(lines);
  put(parts);
  const json document = document_of(bake().bytes);
  EXPECT_EQ(primitive_of(document, 0, 0)["attributes"]["_OCCLUSION"], 2);
  EXPECT_EQ(primitive_of(document, 0, 1)["attributes"]["_OCCLUSION"], 2);
  EXPECT_FALSE(primitive_of(document, 0, 2)["attributes"].contains("_OCCLUSION"));
}

TEST_F(GltfWriter, InstancesOfANodeGetTheirMean) {
  GltfBuilder parts = gltf_cube();
  parts.node(0)["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
      parts.add_values(std::vector<glm::vec3>{{0, 0, 0}, {5, 0, 0}}, kFloat, "VEC3", 1);
  put(parts);
  std::vector<float> values(16, 0.25f);
  values[8] = 0.75f;
  values[9] = NAN;
  const GltfOutput output = bake(values);
  EXPECT_THAT(output.remarks, ElementsAre("1 node shows instances of one mesh, which get their mean occlusion"));
  const std::vector<float> means =
      floats_of(output.bytes, primitive_of(document_of(output.bytes), 0)["attributes"]["_OCCLUSION"]);
  EXPECT_THAT(means, ElementsAre(0.5f, 0.25f, 0.25f, 0.25f, 0.25f, 0.25f, 0.25f, 0.25f));
}

TEST_F(GltfWriter, RefusesWhatWouldBeLost) {
  const auto fault_of = [&](GltfAttribute attribute) -> std::string {
    try {
      GltfFile(path_, folder_.path("out.glb")).check_vertices(attribute);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  GltfBuilder parts = gltf_cube();
  parts.primitive()["attributes"]["COLOR_0"] = 0;
  put(parts);
  EXPECT_EQ(fault_of(GltfAttribute::colour),
            path_ + ": meshes[0].primitives[0] has colours of vertices already, which occlusion would replace");
  EXPECT_EQ(fault_of(GltfAttribute::occlusion), "");
  GltfBuilder draco = draco_cube();
  put(draco);
  EXPECT_EQ(fault_of(GltfAttribute::occlusion), "");
  EXPECT_EQ(bake().bytes.empty(), false);
  draco.document["accessors"][0]["bufferView"] = 0;
  put(draco);
  EXPECT_THAT(fault_of(GltfAttribute::occlusion), HasSubstr("meshes[0].primitives[0] is packed by Draco"));
}

TEST_F(GltfWriter, WrongArgumentsAreNamed) {
  put(gltf_cube());
  EXPECT_THROW(bake({0, 0}), std::invalid_argument);
  EXPECT_THROW(add_maps({{.material = 0, .png = "?"}}), std::invalid_argument) << "it has no material";
  EXPECT_THROW(add_maps({{.png = "?"}, {.png = "?"}}), std::invalid_argument) << "two for one";
  EXPECT_THROW(add_maps({}, -1), std::invalid_argument);
}

TEST_F(GltfWriter, AnotherFileThanWasReadIsAFault) {
  put(cube_at_nodes(2));
  folder_.write("in.glb", gltf_cube().glb());
  try {
    bake();
    ADD_FAILURE() << "taken";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), path_ + ": it has changed since it was read");
  }
}

// ---- files beside ----

TEST_F(GltfWriter, NewBytesLieBesideAText) {
  put(gltf_cube(), "in.gltf");
  const GltfFile file(path_, folder_.path("the output.gltf"));
  const GltfOutput output = file.with_vertices(contents_, std::vector<float>(8, 0.5f), GltfAttribute::occlusion);
  ASSERT_EQ(output.beside.size(), 1u);
  EXPECT_EQ(output.beside[0].name, "the output.occlusion.bin");
  EXPECT_EQ(output.beside[0].bytes, bytes_of(std::vector<float>(8, 0.5f)));
  const json document = json::parse(output.bytes);
  EXPECT_EQ(document["buffers"][1]["uri"], "the%20output.occlusion.bin");
  EXPECT_EQ(document["buffers"][1]["byteLength"], 32);
  EXPECT_EQ(document["bufferViews"][2]["buffer"], 1);
  EXPECT_EQ(document["bufferViews"][2]["byteOffset"], 0);

  const std::string written = folder_.write("the output.gltf", output.bytes);
  folder_.write(output.beside[0].name, output.beside[0].bytes);
  EXPECT_THAT(GltfFile(written, folder_.path("b.gltf")).neighbours(), ElementsAre(folder_.path(output.beside[0].name)));
}

TEST_F(GltfWriter, FilesBesideAreFoundFromAnotherFolder) {
  GltfBuilder parts = cube_with_uvs();
  parts.document["buffers"][0]["uri"] = "a b.bin";
  parts.document["images"] = {{{"uri", "tex/c%23.png"}}, {{"uri", "data:image/png;base64,AAAA"}}};
  std::filesystem::create_directories(folder_.path("model"));
  std::filesystem::create_directories(folder_.path("out/deep"));
  folder_.write("model/a b.bin", parts.buffer);
  path_ = folder_.write("model/in.gltf", parts.document.dump());
  contents_ = open_mesh_file(path_).contents;
  const auto uris_to = [&](const std::string& output) {
    const json document = json::parse(GltfFile(path_, folder_.path(output)).with_maps({}, 0).bytes);
    return std::vector<std::string>{document["buffers"][0]["uri"], document["images"][0]["uri"],
                                    document["images"][1]["uri"]};
  };
  EXPECT_THAT(uris_to("model/out.gltf"), ElementsAre("a b.bin", "tex/c%23.png", "data:image/png;base64,AAAA"));
  EXPECT_THAT(uris_to("out/deep/out.gltf"),
              ElementsAre("../../model/a%20b.bin", "../../model/tex/c%23.png", "data:image/png;base64,AAAA"));
  const std::string there =
      folder_.write("out/deep/out.gltf", GltfFile(path_, folder_.path("out/deep/out.gltf")).with_maps({}, 0).bytes);
  EXPECT_EQ(read_mesh_file(there).triangles.size(), 12u);
}

// ---- from one kind of file to the other ----

TEST_F(GltfWriter, ATextBecomesAGlbWithItsImages) {
  GltfBuilder parts = cube_with_uvs();
  parts.document["buffers"][0]["uri"] = "data.bin";
  parts.document["buffers"][0]["extras"] = 1.5;
  parts.document["images"] = {{{"uri", "a.png"}, {"name", "a"}}, {{"uri", "b.ktx2"}}};
  folder_.write("data.bin", parts.buffer);
  folder_.write("a.png", "\x89PNG, as it were");
  folder_.write("b.ktx2", "another kind");
  path_ = folder_.write("in.gltf", parts.document.dump());
  contents_ = open_mesh_file(path_).contents;
  const std::string bytes = bake().bytes;
  const json document = document_of(bytes);
  EXPECT_EQ(document["buffers"], (json::array({{{"byteLength", binary_of(bytes).size()}, {"extras", 1.5}}})));
  EXPECT_TRUE(binary_of(bytes).starts_with(parts.buffer));
  EXPECT_EQ(document["images"][0], (json{{"bufferView", 3}, {"mimeType", "image/png"}, {"name", "a"}}));
  const json view = document["bufferViews"][3];
  EXPECT_EQ(binary_of(bytes).substr(view["byteOffset"], view["byteLength"]), "\x89PNG, as it were");
  EXPECT_EQ(document["images"][1], (json{{"uri", "b.ktx2"}}));
  EXPECT_EQ(floats_of(bytes, primitive_of(document, 0)["attributes"]["_OCCLUSION"]).size(), 8u);
  EXPECT_EQ(read_mesh_file(folder_.write("out.glb", bytes)).positions, read_mesh_file(path_).positions);
}

TEST_F(GltfWriter, AGlbBecomesATextWithAFileBeside) {
  const GltfBuilder parts = gltf_cube();
  put(parts);
  const GltfFile file(path_, folder_.path("out.gltf"));
  const GltfOutput output = file.with_vertices(contents_, std::vector<float>(8, 0.5f), GltfAttribute::occlusion);
  ASSERT_EQ(output.beside.size(), 1u);
  EXPECT_EQ(output.beside[0].name, "out.bin");
  EXPECT_EQ(output.beside[0].bytes, parts.buffer + bytes_of(std::vector<float>(8, 0.5f)));
  EXPECT_EQ(json::parse(output.bytes)["buffers"],
            (json::array({{{"byteLength", output.beside[0].bytes.size()}, {"uri", "out.bin"}}})));
  folder_.write("out.bin", output.beside[0].bytes);
  EXPECT_EQ(read_mesh_file(folder_.write("out.gltf", output.bytes)).positions, read_mesh_file(path_).positions);
}

TEST_F(GltfWriter, AGlbNeedsTheBufferOfATextThatBecomesOne) {
  GltfBuilder parts = gltf_cube();
  parts.document["buffers"][0]["uri"] = "data.bin";
  folder_.write("data.bin", parts.buffer);
  path_ = folder_.write("in.gltf", parts.document.dump());
  contents_ = open_mesh_file(path_).contents;
  std::filesystem::remove(folder_.path("data.bin"));
  try {
    bake();
    ADD_FAILURE() << "taken";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), path_ + ": its buffer \"data.bin\": no such file");
  }
}

}  // namespace
}  // namespace lkao::scene
