// glTF: what Draco and meshoptimizer packed.
#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include "scene/gltf_packing.h"
#include "scene/gltf_reading.h"

namespace lkao::scene {
namespace {

using nlohmann::json;
using testing::HasSubstr;

TEST(GltfDraco, PrimitivesAreUnpacked) {
  const FileMesh mesh = read(draco_cube());
  EXPECT_EQ(mesh.triangles.size(), 12u);
  expect_box(mesh, {0, 0, 0}, {1, 1, 1}, 1e-4);
  EXPECT_NEAR(volume(mesh), 1, 1e-3);
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  EXPECT_EQ(mesh.normal_corners, mesh.triangles);
  for (const glm::vec3& normal : mesh.normals) EXPECT_LT(glm::distance(normal, glm::vec3(0, 0, 1)), 0.02f);
}

TEST(GltfDraco, DamageIsRefused) {
  const GltfBuilder whole = draco_cube();
  std::size_t refused_count = 0;
  for (std::size_t i = 0; i < whole.buffer.size(); ++i) {
    GltfBuilder parts = whole;
    parts.buffer[i] = static_cast<char>(~parts.buffer[i]);
    try {
      read(parts);
    } catch (const std::runtime_error&) {
      ++refused_count;
    }
  }
  EXPECT_GT(refused_count, 5u);  // the rest are other cubes
  GltfBuilder parts = whole;
  json& view = parts.document["bufferViews"][0]["byteLength"];
  view = view.get<std::size_t>() / 2;
  EXPECT_THAT(refusal(parts), HasSubstr("primitives[0].extensions.KHR_draco_mesh_compression: Draco cannot read its"));
}

TEST(GltfDraco, AttributesMustBeThere) {
  GltfBuilder parts = draco_cube();
  json& attributes = parts.primitive()["extensions"]["KHR_draco_mesh_compression"]["attributes"];
  attributes["NORMAL"] = 77;
  EXPECT_THAT(refusal(parts), HasSubstr("Draco has no attribute 77 of 3 components"));
  // What Draco does not have is looked for outside.
  attributes.erase("NORMAL");
  EXPECT_EQ(read(parts).normals, std::vector<glm::vec3>(read(parts).positions.size(), glm::vec3(0)));
}

TEST(GltfMeshopt, VerticesAndTrianglesAreUnpacked) {
  const FileMesh mesh = read(meshopt_cube());
  expect_box(mesh, {0, 0, 0}, {1, 1, 1}, 0);
  EXPECT_NEAR(volume(mesh), 1, 1e-12);
}

TEST(GltfMeshopt, TheNewNameIsUnderstood) {
  GltfBuilder parts = meshopt_cube();
  parts.document["extensionsRequired"] = {"KHR_meshopt_compression"};
  for (json& view : parts.document["bufferViews"]) {
    view["extensions"]["KHR_meshopt_compression"] = view["extensions"]["EXT_meshopt_compression"];
    view["extensions"].erase("EXT_meshopt_compression");
  }
  EXPECT_NEAR(volume(read(parts)), 1, 1e-12);
}

TEST(GltfMeshopt, IndexSequencesAreUnpacked) {
  GltfBuilder parts = meshopt_cube();
  const std::vector<unsigned> indices(cube_indices().begin(), cube_indices().end());
  std::string packed(meshopt_encodeIndexSequenceBound(indices.size(), 8), '\0');
  packed.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(packed.data()), packed.size(),
                                            indices.data(), indices.size()));
  pack_view(parts, 1, packed, indices.size(), 4, "INDICES");
  parts.document["accessors"][1]["componentType"] = kUint32;
  EXPECT_NEAR(volume(read(parts)), 1, 1e-12);
}

TEST(GltfMeshopt, ExponentialFilterIsUndone) {
  GltfBuilder parts = meshopt_cube();
  std::string filtered(8 * 12, '\0');
  meshopt_encodeFilterExp(filtered.data(), 8, 12, 20, &cube_corners()[0].x);
  pack_view(parts, 0, pack_vertices(filtered, 12), 8, 12, "ATTRIBUTES", "EXPONENTIAL");
  expect_box(read(parts), {0, 0, 0}, {1, 1, 1}, 1e-5);
}

TEST(GltfMeshopt, OctahedralFilterIsUndone) {
  GltfBuilder parts = meshopt_cube();
  const glm::vec3 normal = glm::normalize(glm::vec3(1, 2, -3));
  const std::vector<std::array<float, 4>> normals(8, {normal.x, normal.y, normal.z, 0});
  for (const auto& [stride, type] : {std::pair{4, kInt8}, std::pair{8, kInt16}}) {
    const auto size = static_cast<std::size_t>(stride);
    std::string filtered(8 * size, '\0');
    meshopt_encodeFilterOct(filtered.data(), 8, size, 2 * stride, normals[0].data());
    const std::size_t view = parts.add_view("");
    pack_view(parts, view, pack_vertices(filtered, size), 8, size, "ATTRIBUTES", "OCTAHEDRAL");
    const std::size_t accessor = parts.add_accessor(view, type, 8, "VEC3");
    parts.document["accessors"][accessor]["normalized"] = true;
    parts.primitive()["attributes"]["NORMAL"] = accessor;
    EXPECT_LT(glm::distance(read(parts).normals.at(5), normal), 0.02f) << stride;
  }
}

TEST(GltfMeshopt, QuaternionFilterIsUndone) {
  GltfBuilder parts = meshopt_cube();
  const std::vector<std::array<float, 4>> turn(1, {0, 0, 0.70710678f, 0.70710678f});  // a quarter about z
  std::string filtered(8, '\0');
  meshopt_encodeFilterQuat(filtered.data(), 1, 8, 16, turn[0].data());
  const std::size_t view = parts.add_view("");
  pack_view(parts, view, pack_vertices(filtered, 8), 1, 8, "ATTRIBUTES", "QUATERNION");
  const std::size_t accessor = parts.add_accessor(view, kInt16, 1, "VEC4");
  parts.document["accessors"][accessor]["normalized"] = true;
  parts.node(0)["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] = accessor;
  expect_box(read(parts), {-1, 0, 0}, {0, 1, 1}, 1e-3);
}

TEST(GltfMeshopt, FaultsAreNamed) {
  const std::string place = "/bufferViews/0/extensions/EXT_meshopt_compression/";
  const auto refuse = [&](const std::string& key, const json& value, const char* fault) {
    expect_refused_with(meshopt_cube(), place + key, value, fault);
  };
  refuse("mode", "POINTS", "bufferViews[0].extensions.EXT_meshopt_compression: unknown mode \"POINTS\"");
  refuse("filter", "COLOR", "unknown filter \"COLOR\"");
  refuse("filter", "QUATERNION", "unknown filter \"QUATERNION\" for ATTRIBUTES of 12 bytes each");
  refuse("byteStride", 0, "ATTRIBUTES of 0 bytes each");
  refuse("byteStride", 13, "ATTRIBUTES of 13 bytes each");
  refuse("byteStride", 260, "ATTRIBUTES of 260 bytes each");
  refuse("count", 9007199254740992, "9007199254740992 ATTRIBUTES do not fit into");
  refuse("count", 7, "go beyond bufferViews[0] of 84 bytes");
  refuse("byteLength", 10, "the compressed bytes are damaged");
  refuse("byteOffset", 5, "the compressed bytes are damaged");
  refuse("buffer", 1, "buffers[1] has no uri, and there is no chunk for it");
}

}  // namespace
}  // namespace lkao::scene
