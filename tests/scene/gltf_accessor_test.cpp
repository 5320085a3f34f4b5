// glTF: arrays of numbers.
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/gltf_reading.h"

namespace lkao::scene {
namespace {

using nlohmann::json;
using testing::HasSubstr;

// The cube with other positions: of any type, `scale` for 1.
template <typename Number>
GltfBuilder cube_of(int component_type, Number scale, bool is_normalized) {
  std::vector<Number> numbers;
  for (const glm::vec3& corner : cube_corners()) {
    for (int axis = 0; axis < 3; ++axis)
      numbers.push_back(static_cast<Number>(corner[axis] * static_cast<float>(scale)));
  }
  GltfBuilder builder = gltf_cube();
  const std::size_t accessor = builder.add_values(numbers, component_type, "VEC3", 3);
  builder.document["accessors"][accessor]["normalized"] = is_normalized;
  builder.primitive()["attributes"]["POSITION"] = accessor;
  return builder;
}

template <typename Number>
void expect_type(int component_type, Number largest) {
  SCOPED_TRACE(component_type);
  expect_box(read(cube_of<Number>(component_type, 7, false)), {0, 0, 0}, {7, 7, 7});
  expect_box(read(cube_of<Number>(component_type, largest, true)), {0, 0, 0}, {1, 1, 1});
}

TEST(GltfAccessor, EveryTypeOfNumberIsReadNormalisedOrNot) {
  expect_type<std::int8_t>(kInt8, 127);
  expect_type<std::uint8_t>(kUint8, 255);
  expect_type<std::int16_t>(kInt16, 32767);
  expect_type<std::uint16_t>(kUint16, 65535);
  expect_type<float>(kFloat, 1.0f);
  expect_box(read(cube_of<std::uint32_t>(kUint32, 7, false)), {0, 0, 0}, {7, 7, 7});
}

TEST(GltfAccessor, NormalisedNegativesEndAtMinusOne) {
  expect_box(read(cube_of<std::int8_t>(kInt8, -128, true)), {-1, -1, -1}, {0, 0, 0});
  expect_box(read(cube_of<std::int16_t>(kInt16, -32768, true)), {-1, -1, -1}, {0, 0, 0});
  expect_box(read(cube_of<std::int8_t>(kInt8, -64, true)), {-64.0 / 127, -64.0 / 127, -64.0 / 127}, {0, 0, 0});
}

TEST(GltfAccessor, IndicesAreOfThreeTypes) {
  GltfBuilder bytes = gltf_cube();
  const std::vector<std::uint8_t> small(cube_indices().begin(), cube_indices().end());
  bytes.primitive()["indices"] = bytes.add_values(small, kUint8, "SCALAR", 1);
  EXPECT_NEAR(volume(read(bytes)), 1, 1e-9);
  GltfBuilder words = gltf_cube();
  const std::vector<std::uint32_t> large(cube_indices().begin(), cube_indices().end());
  words.primitive()["indices"] = words.add_values(large, kUint32, "SCALAR", 1);
  EXPECT_NEAR(volume(read(words)), 1, 1e-9);
  words.document["accessors"][2]["componentType"] = kFloat;
  EXPECT_THAT(refusal(words), HasSubstr("accessors[2]: indices of component type 5126"));
}

TEST(GltfAccessor, LastElementNeedNotFillTheStride) {
  GltfBuilder builder = gltf_cube();
  std::string bytes;
  for (const glm::vec3& corner : cube_corners()) {
    bytes += bytes_of(std::vector{corner});
    bytes += std::string(20, '?');
  }
  bytes.resize(bytes.size() - 20);
  const std::size_t view = builder.add_view(bytes, 32);
  builder.primitive()["attributes"]["POSITION"] = builder.add_accessor(view, kFloat, 8, "VEC3");
  expect_box(read(builder), {0, 0, 0}, {1, 1, 1});
  builder.document["bufferViews"][view]["byteLength"] = bytes.size() - 1;
  EXPECT_THAT(refusal(builder), HasSubstr("accessors[2]: 8 elements of 12 bytes at 0 go beyond bufferViews[2] of 235"));
}

TEST(GltfAccessor, UnalignedNumbersAreRead) {
  GltfBuilder builder = gltf_cube();
  const std::size_t view = builder.add_view("?" + bytes_of(cube_corners()));
  const std::size_t accessor = builder.add_accessor(view, kFloat, 8, "VEC3");
  builder.document["accessors"][accessor]["byteOffset"] = 1;
  builder.primitive()["attributes"]["POSITION"] = accessor;
  expect_box(read(builder), {0, 0, 0}, {1, 1, 1});
}

// The two upper corners at x = 0 are moved to z = 3.
json sparse_corners(GltfBuilder& builder) {
  const std::vector<glm::vec3> values{{0, 0, 3}, {0, 1, 3}};
  const std::size_t indices = builder.add_view(bytes_of(std::vector<std::uint8_t>{4, 7}));
  return {{"count", 2},
          {"indices", {{"bufferView", indices}, {"componentType", kUint8}}},
          {"values", {{"bufferView", builder.add_view(bytes_of(values))}}}};
}

TEST(GltfAccessor, SparseOnesReplaceElementsOfAView) {
  GltfBuilder builder = gltf_cube();
  builder.document["accessors"][0]["sparse"] = sparse_corners(builder);
  const FileMesh mesh = read(builder);
  EXPECT_EQ(mesh.positions[4], glm::dvec3(0, 0, 3));
  EXPECT_EQ(mesh.positions[7], glm::dvec3(0, 1, 3));
  EXPECT_EQ(mesh.positions[5], glm::dvec3(1, 0, 1));
}

TEST(GltfAccessor, SparseOnesWithoutAViewStandOnZeros) {
  GltfBuilder builder = gltf_cube();
  builder.document["accessors"][0].erase("bufferView");
  builder.document["accessors"][0]["sparse"] = sparse_corners(builder);
  const FileMesh mesh = read(builder);
  EXPECT_EQ(mesh.positions[4], glm::dvec3(0, 0, 3));
  EXPECT_EQ(mesh.positions[5], glm::dvec3(0, 0, 0));
}

TEST(GltfAccessor, SparseElementsMustExist) {
  GltfBuilder builder = gltf_cube();
  builder.document["accessors"][0]["sparse"] = sparse_corners(builder);
  builder.buffer[builder.document["bufferViews"][2]["byteOffset"].get<std::size_t>()] = 8;
  EXPECT_THAT(refusal(builder), HasSubstr("accessors[0].sparse.indices names element 8 of 8"));
  builder.document["accessors"][0]["sparse"]["count"] = 3;
  EXPECT_THAT(refusal(builder), HasSubstr("accessors[0].sparse.indices: 3 elements of 1 bytes at 0 go beyond"));
}

TEST(GltfAccessor, NoViewIsZerosButNoMoreThanTheFileIsLong) {
  GltfBuilder builder = gltf_cube();
  builder.document["accessors"][0].erase("bufferView");
  EXPECT_EQ(read(builder).positions, std::vector<glm::dvec3>(8, glm::dvec3(0)));
  builder.document["accessors"][0]["count"] = 1000000000000;
  EXPECT_THAT(refusal(builder), HasSubstr("accessors[0]: 1000000000000 elements without a bufferView"));
}

TEST(GltfAccessor, FaultsAreNamed) {
  const auto refuse = [](const char* pointer, const json& value, const char* fault) {
    expect_refused_with(gltf_cube(), pointer, value, fault);
  };
  refuse("/accessors/0/count", 9, "accessors[0]: 9 elements of 12 bytes at 0 go beyond bufferViews[0] of 96 bytes");
  refuse("/accessors/0/count", 9007199254740992, "go beyond bufferViews[0]");
  refuse("/accessors/0/count", -1, "accessors[0].count is -1, not a count");
  refuse("/accessors/0/count", "many\nlines", "accessors[0].count is \"many lines\", not a count");
  refuse("/accessors/0/byteOffset", 1, "accessors[0]: 8 elements of 12 bytes at 1 go beyond");
  refuse("/accessors/0/byteOffset", 9007199254740992, "go beyond bufferViews[0]");
  refuse("/accessors/0/componentType", 5124, "accessors[0].componentType is 5124");
  refuse("/accessors/0/type", "VEC2",
         "accessors[0] is \"VEC2\", but meshes[0].primitives[0].attributes.POSITION needs");
  refuse("/accessors/0/bufferView", 7, "accessors[0].bufferView names bufferViews[7], which does not exist");
  refuse("/bufferViews/0/byteLength", 1000, "bufferViews[0]: 1000 bytes at 0 go beyond its buffer of 168");
  refuse("/bufferViews/0/byteOffset", 9007199254740992, "go beyond its buffer of 168");
  refuse("/bufferViews/0/byteStride", 8, "bufferViews[0]: the stride 8 is below the 12 bytes");
  refuse("/bufferViews/0/buffer", 1, "bufferViews[0].buffer names buffers[1], which does not exist");
  refuse("/buffers/0/byteLength", 169, "buffers[0] is truncated: 168 of 169 bytes");
  refuse("/accessors", json::object(), "accessors is an object, not a list");
}

}  // namespace
}  // namespace lkao::scene
