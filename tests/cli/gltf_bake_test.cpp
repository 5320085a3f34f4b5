// lkao bake of glTF and GLB into what they are.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <glm/common.hpp>

#include "cli/program.h"
#include "cli/small_mesh.h"
#include "image/image.h"
#include "scene/formats/gltf/container.h"
#include "scene/gltf_builder.h"
#include "scene/mesh_file.h"

namespace lkao::test {
namespace {

using scene::GltfBuilder;

class GltfBake : public ProgramTest {
 protected:
  Arguments bake(const std::string& scene, const std::string& output, const Arguments& more = {}) const {
    Arguments arguments = {"bake", scene, "-o", path(output), "--radius", "5", "--samples", "64", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  // Of an accessor in GLB's own buffer, as long as the file is in the test's folder.
  std::vector<float> floats(const std::string& name, std::size_t accessor_number) const {
    const std::string bytes = read_file(name);
    const scene::gltf::Container container = scene::gltf::open_container(bytes);
    const nlohmann::json document = nlohmann::json::parse(container.json);
    const nlohmann::json& accessor = document["accessors"].at(accessor_number);
    const nlohmann::json& view = document["bufferViews"].at(accessor["bufferView"].get<std::size_t>());
    std::vector<float> values(accessor["count"].get<std::size_t>());
    const std::size_t begin = view["byteOffset"].get<std::size_t>() + accessor["byteOffset"].get<std::size_t>();
    std::memcpy(values.data(), container.binary->substr(begin).data(), 4 * values.size());
    return values;
  }
};

// Two nodes that show one mesh, one beside the other.
GltfBuilder two_cubes() {
  GltfBuilder parts = scene::gltf_cube();
  parts.document["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {1.25, 0, 0}}, {"scale", {1, 2, 1}}}};
  parts.document["scenes"][0]["nodes"] = {0, 1};
  return parts;
}

TEST_F(GltfBake, VerticesHaveTheValuesOfAPly) {
  const std::string model = write_file("in.glb", two_cubes().glb());
  expect_success(bake(model, "out.glb"));
  expect_success(bake(model, "out.ply"));
  EXPECT_EQ(files(), (std::vector<std::string>{"in.glb", "out.glb", "out.ply"}));
  const std::string ply = read_file("out.ply");
  const std::size_t first = ply.find("end_header\n") + 11;
  std::vector<float> values;
  for (const std::size_t accessor : {std::size_t{2}, std::size_t{3}}) {
    for (const float value : floats("out.glb", accessor)) values.push_back(value);
  }
  ASSERT_EQ(values.size(), 16u);
  float largest = 0;
  for (std::size_t i = 0; i < 16; ++i) {
    float value = -1;
    std::memcpy(&value, ply.data() + first + 19 * i + 12, sizeof value);
    EXPECT_EQ(values[i], value) << i;
    largest = std::max(largest, value);
  }
  EXPECT_GT(largest, 0.1f);
  EXPECT_EQ(scene::read_mesh_file(path("out.glb")).positions, scene::read_mesh_file(model).positions);
}

TEST_F(GltfBake, ColoursAreWrittenOnRequest) {
  const std::string model = write_file("in.glb", scene::gltf_cube().glb());
  expect_success(bake(model, "out.glb", {"--attribute", "color"}));
  EXPECT_NE(read_file("out.glb").find("\"COLOR_0\":2"), std::string::npos);
  expect_rejected(bake(path("out.glb"), "again.glb", {"--attribute", "color"}),
                  {"out.glb: meshes[0].primitives[0] has colours of vertices already"});
}

TEST_F(GltfBake, ATextHasItsBytesBesideIt) {
  const std::string model = write_file("in.gltf", scene::gltf_cube().gltf());
  expect_success(bake(model, "out.gltf"));
  EXPECT_EQ(files(), (std::vector<std::string>{"in.gltf", "out.gltf", "out.occlusion.bin"}));
  EXPECT_EQ(read_file("out.occlusion.bin").size(), 32u);
  // What the model itself is made of is not overwritten.
  expect_rejected(bake(path("out.gltf"), "out.gltf"), {"out.gltf': it is an input"});
  std::filesystem::rename(path("out.gltf"), path("other.gltf"));
  expect_rejected(bake(path("other.gltf"), "out.gltf"), {"out.occlusion.bin': it is an input"});
}

TEST_F(GltfBake, EitherKindBecomesTheOther) {
  const std::string model = write_file("in.glb", scene::gltf_cube().glb());
  expect_success(bake(model, "out.gltf"));
  EXPECT_EQ(files(), (std::vector<std::string>{"in.glb", "out.bin", "out.gltf"}));
  expect_success(bake(path("out.gltf"), "back.glb"));
  expect_success(bake(model, "direct.glb"));
  EXPECT_EQ(scene::read_mesh_file(path("back.glb")).positions, scene::read_mesh_file(model).positions);
  EXPECT_EQ(floats("back.glb", 3), floats("direct.glb", 2));
}

TEST_F(GltfBake, WhatCannotBeWrittenIsSaidBefore) {
  const std::string model = write_file("in.glb", scene::gltf_cube().glb());
  const std::string mesh = write_file("square.ply", roofed_square_ply());
  expect_rejected(bake(mesh, "out.glb"), {"--output", "square.ply' is no .gltf or .glb", "write a .ply or .obj"});
  expect_rejected(bake("builtin:wall", "out.gltf"), {"--output", "builtin:wall"});
  expect_rejected(bake(model, "out.glb", {"--per", "corner"}), {"--per corner", "values of vertices alone"});
  expect_rejected(bake(model, "out.glb", {"--per", "face"}), {"--per face"});
  expect_rejected(bake(model, "out.glb", {"--quality"}), {"--quality is for a .ply"});
  expect_rejected(bake(model, "out.ply", {"--attribute", "color"}), {"--attribute is for a .gltf or .glb"});
  expect_rejected(bake(model, "out.glb", {"--attribute", "grey"}), {"--attribute", "grey", "occlusion or color"});
  expect_rejected(bake(model, "no/such/folder/out.glb"), {"there is no folder"});
}

TEST_F(GltfBake, InstancesOfANodeAreRemarkedOn) {
  GltfBuilder parts = scene::gltf_cube();
  parts.node(0)["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
      parts.add_values(std::vector<glm::vec3>{{0, 0, 0}, {1.5f, 0, 0}}, scene::kFloat, "VEC3", 1);
  const ProgramResult result = run_program(bake(write_file("in.glb", parts.glb()), "out.glb"));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err,
            "lkao: " + path("out.glb") + ": 1 node shows instances of one mesh, which get their mean occlusion\n");
}

std::filesystem::path sample(const char* name) { return std::filesystem::path(LKAO_SHARED_DIR) / "models" / name; }

#define NEEDS_SAMPLE(NAME)                                  \
  if (!std::filesystem::exists(sample(NAME)))               \
  GTEST_SKIP() << "NOT TESTED: the sample model " << (NAME) \
               << " is missing (looked in " LKAO_SHARED_DIR \
                  "; set the environment variable or the CMake variable LKAO_SHARED_DIR)"

TEST_F(GltfBake, SampleModelsComeOutAsTheyWentIn) {
  for (const char* const name : {"BoxTextured.glb", "DamagedHelmet.gltf"}) {
    NEEDS_SAMPLE(name);
    const std::string model = sample(name).string();
    const std::string output = "out" + sample(name).extension().string();
    expect_success({"bake", model, "-o", path(output), "--radius", "5%", "--samples", "16", "--quiet"});
    const scene::Mesh before = scene::read_mesh_file(model, {.uv_set = 0});
    const scene::Mesh after = scene::read_mesh_file(path(output), {.uv_set = 0});
    EXPECT_EQ(before.positions, after.positions) << name;
    EXPECT_EQ(before.triangles, after.triangles) << name;
    EXPECT_EQ(before.uvs, after.uvs) << name;
    EXPECT_FALSE(before.uvs.empty()) << name;
    EXPECT_NE(read_file(output).find("\"_OCCLUSION\":"), std::string::npos) << name;
  }
}

// The pixel at texture coordinates, which wrap.
float pixel_at(const image::Image& image, const glm::vec2& uv) {
  const glm::vec2 inside = uv - glm::floor(uv);
  const auto x = std::min(static_cast<std::size_t>(inside.x * static_cast<float>(image.width)),
                          static_cast<std::size_t>(image.width) - 1);
  const auto y = std::min(static_cast<std::size_t>(inside.y * static_cast<float>(image.height)),
                          static_cast<std::size_t>(image.height) - 1);
  return image.pixels[(y * static_cast<std::size_t>(image.width) + x) * image.channels.size()];
}

double correlation_of(const std::vector<float>& a, const std::vector<float>& b) {
  double sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double x = static_cast<double>(a[i]), y = static_cast<double>(b[i]);
    sum_a += x, sum_b += y, aa += x * x, bb += y * y, ab += x * y;
  }
  const auto n = static_cast<double>(a.size());
  return (ab - sum_a * sum_b / n) / std::sqrt((aa - sum_a * sum_a / n) * (bb - sum_b * sum_b / n));
}

// Texture coordinates are read as they are meant: v runs from 1 to 2 there, and points down.
TEST_F(GltfBake, TheHelmetIsDarkWhereItsOwnMapIs) {
  NEEDS_SAMPLE("DamagedHelmet.gltf");
  NEEDS_SAMPLE("Default_AO.jpg");
  const std::string model = sample("DamagedHelmet.gltf").string();
  expect_success({"bake", model, "-o", path("out.glb"), "--radius", "20%", "--samples", "64", "--quiet"});
  const std::vector<float> occlusion = floats("out.glb", 4);
  const scene::Mesh mesh = scene::read_mesh_file(model, {.uv_set = 0});
  ASSERT_EQ(mesh.uvs.size(), occlusion.size());
  const image::Image map = image::read_image(sample("Default_AO.jpg").string());
  std::vector<float> drawn(occlusion.size()), upside_down(occlusion.size());
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    drawn[i] = 1 - pixel_at(map, mesh.uvs[i]);
    upside_down[i] = 1 - pixel_at(map, {mesh.uvs[i].x, 1 - mesh.uvs[i].y});
  }
  EXPECT_GT(correlation_of(occlusion, drawn), 0.4);
  EXPECT_LT(correlation_of(occlusion, upside_down), 0.2);
}

}  // namespace
}  // namespace lkao::test
