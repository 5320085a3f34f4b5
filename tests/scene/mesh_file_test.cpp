// glTF and GLB in, and what is refused whatever the type.
#include "scene/mesh_file.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "scene/defects.h"
#include "scene/files.h"
#include "scene/load.h"

namespace lkao::scene {
namespace {

using nlohmann::json;

const std::vector<glm::vec3> kSquare = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

// ---- any type ----

TEST(MeshFile, MissingFilesFoldersAndUnknownTypesAreRefused) {
  const TemporaryFolder folder;
  expect_refused(folder.path("missing.ply"), "no such file");
  expect_refused(folder.path(""), "is a directory");
  expect_refused(folder.write("a.xyz", "1 2 3\n"), "not a supported mesh type");
  expect_refused(folder.write("noextension", "1 2 3\n"), "not a supported mesh type");
  EXPECT_THROW(load("builtin:nothing"), std::runtime_error);
}

TEST(MeshFile, EmptyFilesAndGarbageAreRefused) {
  const TemporaryFolder folder;
  std::string garbage;
  for (int i = 0; i < 3000; ++i) garbage += static_cast<char>(i * 37 + 11);
  for (const char* extension : {"ply", "obj", "stl", "off", "gltf", "glb"}) {
    expect_refused(folder.write(std::string("empty.") + extension, ""), "empty");
    expect_refused(folder.write(std::string("garbage.") + extension, garbage), "");
  }
}

// ---- glTF ----

struct GltfParts {
  json document;
  std::string buffer;
};

// Nodes: "nodes" and "scenes" are the caller's. One mesh 0 of one primitive.
GltfParts gltf_square(const std::vector<std::uint16_t>& indices, int mode = 4) {
  GltfParts parts;
  for (std::uint16_t index : indices) parts.buffer += raw(index);
  parts.buffer.resize((parts.buffer.size() + 3) / 4 * 4);
  const std::size_t positions_at = parts.buffer.size();
  for (const glm::vec3& p : kSquare) parts.buffer += raw(p);
  parts.document = {
      {"asset", {{"version", "2.0"}}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", {{{"mesh", 0}}}},
      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 1}}}, {"indices", 0}, {"mode", mode}}}}}}},
      {"buffers", {{{"byteLength", parts.buffer.size()}}}},
      {"bufferViews",
       {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 2 * indices.size()}},
        {{"buffer", 0}, {"byteOffset", positions_at}, {"byteLength", 48}}}},
      {"accessors",
       {{{"bufferView", 0}, {"componentType", 5123}, {"count", indices.size()}, {"type", "SCALAR"}},
        {{"bufferView", 1},
         {"componentType", 5126},
         {"count", 4},
         {"type", "VEC3"},
         {"min", {0, 0, 0}},
         {"max", {1, 1, 0}}}}}};
  return parts;
}

// A .gltf beside its .bin.
std::string write_gltf(const TemporaryFolder& folder, GltfParts parts) {
  folder.write("a.bin", parts.buffer);
  parts.document["buffers"][0]["uri"] = "a.bin";
  return folder.write("a.gltf", parts.document.dump());
}

std::string glb_bytes(const GltfParts& parts) {
  std::string text = parts.document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const auto size = [](std::size_t n) { return raw(static_cast<std::uint32_t>(n)); };
  return "glTF" + raw(std::uint32_t{2}) + size(28 + text.size() + parts.buffer.size()) + size(text.size()) + "JSON" +
         text + size(parts.buffer.size()) + std::string("BIN\0", 4) + parts.buffer;
}

glm::vec3 front(const Mesh& mesh, std::size_t triangle) {
  const std::vector<glm::vec3> p = corners(mesh, triangle);
  return glm::cross(p[1] - p[0], p[2] - p[0]);
}

TEST(Gltf, TextAndBinaryGiveTheSame) {
  const TemporaryFolder folder;
  const GltfParts parts = gltf_square({0, 1, 2, 0, 2, 3, 1, 1, 2});
  const std::string paths[] = {write_gltf(folder, parts), folder.write("a.glb", glb_bytes(parts))};
  for (const std::string& path : paths) {
    const Mesh mesh = read_mesh_file(path);
    ASSERT_EQ(mesh.triangles.size(), 3u) << path;
    EXPECT_EQ(corners(mesh, 1), (std::vector<glm::vec3>{kSquare[0], kSquare[2], kSquare[3]}));
    EXPECT_EQ(mesh.positions.size(), 4u);
  }
}

TEST(Gltf, StripsAndFansAreTriangles) {
  const TemporaryFolder folder;
  for (const GltfParts& parts : {gltf_square({0, 1, 3, 2}, 5), gltf_square({0, 1, 2, 3}, 6)}) {
    const Mesh mesh = read_mesh_file(write_gltf(folder, parts));
    ASSERT_EQ(mesh.triangles.size(), 2u);
    for (std::size_t t = 0; t < 2; ++t) EXPECT_EQ(front(mesh, t), glm::vec3(0, 0, 1));
  }
}

TEST(Gltf, NodeTransformsMultiplyDownTheTree) {
  const TemporaryFolder folder;
  GltfParts parts = gltf_square({0, 1, 2});
  parts.document["nodes"] = {{{"translation", {0, 0, 5}}, {"scale", {2, 2, 2}}, {"children", {1, 2}}},
                             {{"mesh", 0}, {"rotation", {0, 0, 1, 0}}},  // half a turn about z
                             {{"mesh", 0}, {"translation", {10, 0, 0}}}};
  const Mesh mesh = read_mesh_file(write_gltf(folder, parts));
  ASSERT_EQ(mesh.triangles.size(), 2u);
  const std::vector<glm::vec3> turned = corners(mesh, 0);
  const std::vector<glm::vec3> moved = corners(mesh, 1);
  EXPECT_LT(glm::distance(turned[2], glm::vec3(-2, -2, 5)), 1e-5f);
  EXPECT_EQ(moved[2], glm::vec3(22, 2, 5));
}

TEST(Gltf, MirroringNodesKeepTheFront) {
  // The square looks along +z; mirrored in x it still does.
  const TemporaryFolder folder;
  GltfParts parts = gltf_square({0, 1, 2, 0, 2, 3});
  parts.document["nodes"] = {{{"mesh", 0}, {"scale", {-2, 1, 1}}}};
  const Mesh mesh = read_mesh_file(write_gltf(folder, parts));
  ASSERT_EQ(mesh.triangles.size(), 2u);
  for (std::size_t t = 0; t < 2; ++t) EXPECT_EQ(front(mesh, t), glm::vec3(0, 0, 2));
  EXPECT_EQ(bounds_of(mesh).lower.x, -2);
}

TEST(Gltf, BadIndicesAreRefused) {
  const TemporaryFolder folder;
  expect_refused(write_gltf(folder, gltf_square({0, 1, 2, 0, 2, 9})), "only 1 of its 2 triangles");
  expect_refused(write_gltf(folder, gltf_square({0, 1, 2, 0})), "a list of triangles has 4 indices");
  GltfParts parts = gltf_square({0, 1, 2});
  parts.document["accessors"][0]["count"] = 999;
  expect_refused(write_gltf(folder, parts), "out of range");
}

TEST(Gltf, TruncationsAreRefused) {
  const TemporaryFolder folder;
  const GltfParts parts = gltf_square({0, 1, 2, 0, 2, 3});
  const std::string binary = glb_bytes(parts);
  for (std::size_t size = 1; size < binary.size(); size += 7) {
    ASSERT_FALSE(refusal_of(folder.write("cut.glb", binary.substr(0, size))).empty()) << size;
  }
  expect_refused(folder.write("cut.glb", binary.substr(0, binary.size() - 5)), "truncated");

  const std::string text = parts.document.dump();
  expect_refused(folder.write("cut.gltf", text.substr(0, text.size() / 2)), "truncated or malformed glTF");

  GltfParts short_buffer = parts;
  short_buffer.buffer.resize(short_buffer.buffer.size() - 9);
  expect_refused(write_gltf(folder, short_buffer), "its buffer a.bin is truncated");
  std::filesystem::remove(folder.path("a.bin"));
  expect_refused(folder.path("a.gltf"), "a.bin");
}

}  // namespace
}  // namespace lkao::scene
