// glTF: the two forms of the file, what is beside it, and what it asks of a reader.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/files.h"
#include "scene/gltf_reading.h"

namespace lkao::scene {
namespace {

using nlohmann::json;
using testing::HasSubstr;

// Its buffer in a file beside it, which is named `uri` in the text and `file` on the disk.
std::string write_apart(const TemporaryFolder& folder, GltfBuilder parts, const std::string& uri = "a.bin",
                        const std::string& file = "a.bin") {
  folder.write(file, parts.buffer);
  parts.document["buffers"][0]["uri"] = uri;
  return folder.write("a.gltf", parts.document.dump());
}

TEST(GltfFile, TextAndBinaryGiveTheSame) {
  const TemporaryFolder folder;
  const GltfBuilder parts = gltf_square({0, 1, 2, 0, 2, 3, 1, 1, 2});
  for (const std::string& path : {write_apart(folder, parts), folder.write("a.glb", parts.glb()),
                                  folder.write("b.gltf", parts.gltf()), folder.write("c.gltf", parts.glb())}) {
    const Mesh mesh = read_mesh_file(path);
    EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}, {1, 1, 2}})) << path;
    EXPECT_EQ(mesh.positions.size(), 4u);
  }
}

TEST(GltfFile, TruncationsAreRefused) {
  const TemporaryFolder folder;
  const GltfBuilder parts = gltf_square({0, 1, 2, 0, 2, 3});
  const std::string binary = parts.glb();
  for (std::size_t size = 1; size < binary.size(); ++size) ASSERT_NE(refusal(binary.substr(0, size)), "") << size;
  EXPECT_THAT(refusal(binary.substr(0, binary.size() - 5)), HasSubstr("truncated"));

  const std::string text = parts.gltf();
  for (std::size_t size = 1; size < text.size(); ++size) ASSERT_NE(refusal(text.substr(0, size)), "") << size;
  expect_refused(folder.write("cut.gltf", text.substr(0, text.size() / 2)), "truncated or malformed glTF: parse error");

  GltfBuilder short_buffer = parts;
  short_buffer.buffer.resize(short_buffer.buffer.size() - 9);
  expect_refused(write_apart(folder, short_buffer), "its buffer \"a.bin\" is truncated: 51 of 60 bytes");
  std::filesystem::remove(folder.path("a.bin"));
  expect_refused(folder.path("a.gltf"), "its buffer \"a.bin\": no such file");
}

// ---- GLB ----

const std::string kBinary("BIN\0", 4);

TEST(Glb, ChunksBeginWhereTheLengthSays) {
  const GltfBuilder parts = gltf_cube();
  for (const char* blanks : {"", " ", "  ", "   "}) {
    const Chunk text{"JSON", parts.document.dump() + blanks};
    EXPECT_EQ(read_gltf("", glb_of({text, {kBinary, parts.buffer}})).triangles.size(), 12u);
  }
}

TEST(Glb, UnknownChunksAndZerosBehindTheTextAreSkipped) {
  const GltfBuilder parts = gltf_cube();
  const Chunk text{"JSON", parts.document.dump() + std::string(3, '\0')};
  EXPECT_EQ(read_gltf("", glb_of({text, {"MORE", "?"}, {kBinary, parts.buffer}, {"LAST", ""}})).triangles.size(), 12u);
  EXPECT_EQ(read_gltf("", glb_of({text, {kBinary, parts.buffer}}) + "behind").triangles.size(), 12u);
}

TEST(Glb, BuffersMayBeBesideIt) {
  const TemporaryFolder folder;
  GltfBuilder parts = gltf_cube();
  folder.write("a.bin", parts.buffer);
  parts.document["buffers"][0]["uri"] = "a.bin";
  EXPECT_EQ(read_mesh_file(folder.write("a.glb", glb_of({{"JSON", parts.document.dump()}}))).triangles.size(), 12u);
}

TEST(Glb, FaultsAreNamed) {
  const GltfBuilder parts = gltf_cube();
  const std::string text = parts.document.dump();
  EXPECT_THAT(refusal("glTF"), HasSubstr("truncated GLB: there is no header"));
  EXPECT_THAT(refusal(glb_of({{kBinary, text}})), HasSubstr("its first chunk is not JSON"));
  EXPECT_THAT(refusal(glb_of({{"JSON", text}})), HasSubstr("buffers[0] has no uri, and there is no chunk for it"));
  EXPECT_THAT(refusal(glb_of({{"JSON", text}, {kBinary, parts.buffer.substr(0, 100)}})),
              HasSubstr("its buffer buffers[0] is truncated: 100 of 168 bytes"));
  std::string bytes = parts.glb();
  bytes[4] = 1;
  EXPECT_THAT(refusal(bytes), HasSubstr("GLB version 1 is not supported"));
  bytes = parts.glb();
  bytes[15] = '\x7f';
  EXPECT_THAT(refusal(bytes), HasSubstr("malformed GLB: a chunk of"));
}

// ---- URIs ----

TEST(GltfUri, IsPercentEncodedOrNot) {
  const TemporaryFolder folder;
  const GltfBuilder parts = gltf_cube();
  for (const auto& [uri, file] :
       {std::pair{"two%20words.bin", "two words.bin"}, std::pair{"%c3%A9.bin", "\xc3\xa9.bin"},
        std::pair{"three words.bin", "three words.bin"}, std::pair{"50%.bin", "50%.bin"},
        std::pair{"not%20decoded.bin", "not%20decoded.bin"}, std::pair{"./a.bin", "a.bin"}}) {
    EXPECT_EQ(read_mesh_file(write_apart(folder, parts, uri, file)).triangles.size(), 12u) << uri;
  }
}

TEST(GltfUri, DataIsBase64OrPercentEncoded) {
  GltfBuilder parts = gltf_cube();
  const auto read_from = [&](const std::string& uri) {
    parts.document["buffers"][0]["uri"] = uri;
    return read_gltf("", parts.document.dump()).triangles.size();
  };
  std::string escaped;
  for (const char c : parts.buffer) {
    constexpr char kDigits[] = "0123456789abcdef";
    const auto byte = static_cast<unsigned char>(c);
    escaped += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
  }
  std::string base64 = to_base64(parts.buffer);
  EXPECT_EQ(read_from("data:application/gltf-buffer;base64," + base64), 12u);
  EXPECT_EQ(read_from("data:application/octet-stream," + escaped), 12u);
  while (base64.ends_with('=')) base64.pop_back();
  EXPECT_EQ(read_from("data:;base64," + base64), 12u);
  base64.replace(base64.find('A'), 1, "%41");
  EXPECT_EQ(read_from("data:;base64," + base64), 12u);
  parts.document["buffers"][0]["uri"] = "data:;base64,AA*A";
  EXPECT_THAT(refusal(parts.document.dump()), HasSubstr("\"*\" is no character of base64"));
  parts.document["buffers"][0]["uri"] = "data:text";
  EXPECT_THAT(refusal(parts.document.dump()), HasSubstr("its data: URI has no comma"));
}

TEST(GltfUri, MustNameAFile) {
  const TemporaryFolder folder;
  expect_refused(write_apart(folder, gltf_cube(), "."), "its buffer \".\": is no file");
  expect_refused(write_apart(folder, gltf_cube(), "https://example.org/a.bin"), "scheme \"https\" are not supported");
}

TEST(GltfUri, BuffersOfImagesAloneNeedNotExist) {
  GltfBuilder parts = gltf_cube();
  parts.document["buffers"].push_back({{"byteLength", 1000}, {"uri", "missing.bin"}});
  parts.document["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 1000}});
  EXPECT_EQ(read(parts).triangles.size(), 12u);
}

// ---- the document ----

TEST(GltfDocument, MayBeginWithAByteOrderMark) {
  EXPECT_EQ(read_gltf("", "\xef\xbb\xbf" + gltf_cube().gltf()).triangles.size(), 12u);
}

TEST(GltfDocument, OtherVersionsAreRefused) {
  GltfBuilder parts = gltf_cube();
  parts.document["asset"] = {{"version", "2.1"}};
  EXPECT_EQ(read(parts).triangles.size(), 12u);
  parts.document["asset"]["minVersion"] = "2.0";
  EXPECT_EQ(read(parts).triangles.size(), 12u);
  parts.document["asset"]["minVersion"] = "2.1";
  EXPECT_THAT(refusal(parts), HasSubstr("it needs glTF \"2.1\", but only 2.0 is supported"));
  parts.document["asset"] = {{"version", "1.0"}};
  EXPECT_THAT(refusal(parts), HasSubstr("glTF \"1.0\" is not supported, only 2.0"));
  parts.document.erase("asset");
  EXPECT_THAT(refusal(parts), HasSubstr("the document has no \"asset\""));
}

TEST(GltfDocument, UnknownRequirementsAreRefusedByName) {
  GltfBuilder parts = gltf_cube();
  parts.document["extensionsUsed"] = {"VENDOR_anything"};
  parts.document["extensionsRequired"] = {"KHR_mesh_quantization", "KHR_materials_unlit", "KHR_texture_basisu"};
  EXPECT_EQ(read(parts).triangles.size(), 12u);
  parts.document["extensionsRequired"].push_back("VENDOR_other_geometry");
  EXPECT_THAT(refusal(parts), HasSubstr("it needs the extension \"VENDOR_other_geometry\", which is not supported"));
}

TEST(GltfDocument, DeepNestingIsNoFault) {
  const TemporaryFolder folder;
  constexpr std::size_t kDepth = 200000;
  const std::string nested =
      "{\"asset\":{\"version\":\"2.0\"},\"extras\":" + std::string(kDepth, '[') + std::string(kDepth, ']') + "}";
  expect_refused(folder.write("nested.gltf", nested), "there are no triangles in it");
  expect_refused(folder.write("open.gltf", nested.substr(0, kDepth)), "truncated or malformed glTF");
}

TEST(GltfDocument, FaultsAreOneShortLine) {
  for (const std::string& text : {std::string("{\"asset\": \n\n"), "{\"asset\": \"" + std::string(5000, 'x'),
                                  std::string("[1, 2]"), std::string("nul"), std::string(" ")}) {
    const std::string fault = refusal(text);
    EXPECT_LT(fault.size(), 300u) << fault;
    EXPECT_EQ(fault.find('\n'), fault.npos) << fault;
  }
}

}  // namespace
}  // namespace lkao::scene
