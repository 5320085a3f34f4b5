#include <array>
#include <cstring>

#include <fmt/format.h>

#include "cli/program.h"
#include "cli/small_mesh.h"
#include "scene/load.h"
#include "support/sanitized.h"

namespace lkao::test {
namespace {

class Bake : public ProgramTest {
 protected:
  Arguments bake_to(const std::string& output, const std::string& scene, const Arguments& more = {}) const {
    Arguments arguments = {"bake", scene, "-o", path(output), "--radius", "5", "--json", path("out.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  Arguments bake(const std::string& scene, const Arguments& more = {}) const {
    Arguments arguments = bake_to("out.ply", scene, more);
    arguments.insert(arguments.end(), {"--samples", "64"});
    return arguments;
  }
  // Occlusion of vertex k: the fourth float of the 19 bytes of a vertex.
  float occlusion(std::size_t k) const {
    const std::string bytes = read_file("out.ply");
    const std::string end = "end_header\n";
    const std::size_t first = bytes.find(end) + end.size();
    float value = -1;
    std::memcpy(&value, bytes.data() + first + 19 * k + 12, sizeof value);
    return value;
  }
};

TEST_F(Bake, TheMeshLoadsBack) {
  expect_success(bake("builtin:wall"));
  const scene::Mesh before = scene::load("builtin:wall");
  const scene::Mesh after = scene::load(path("out.ply"));
  EXPECT_EQ(before.positions, after.positions);
  EXPECT_EQ(before.triangles, after.triangles);
  EXPECT_EQ(files(), (std::vector<std::string>{"out.json", "out.ply"}));
}

TEST_F(Bake, DarkensUnderARoofOnly) {
  expect_success(bake(write_file("square.ply", roofed_square_ply())));
  EXPECT_GT(occlusion(0), 0.1f);  // a corner below the roof
  EXPECT_GT(occlusion(3), occlusion(1));
  EXPECT_EQ(read_json("out.json")["receivers"], 9);  // corners
}

TEST_F(Bake, AnInfiniteRadiusReachesEverything) {
  const std::string scene = write_file("square.ply", roofed_square_ply());
  const auto vertices = [&](const std::string& radius) {
    expect_success({"bake", scene, "-o", path("out.ply"), "--radius", radius, "--json", path("out.json")});
    return read_file("out.ply");
  };
  EXPECT_TRUE(vertices("inf") == vertices("1024"));
  EXPECT_TRUE(vertices("inf") != vertices("0.25"));
  vertices("inf");
  EXPECT_TRUE(read_json("out.json").at("radius").is_null());
}

TEST_F(Bake, JsonHasTheKeysOfARendering) {
  expect_success(bake("builtin:wall"));
  const nlohmann::json json = read_json("out.json");
  for (const char* key : {"method", "scene", "radius", "samples", "vertices", "receivers", "rays", "seconds",
                          "mrays_per_second", "occlusion_mean", "vertices_without_normal"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["rays"], json["receivers"].get<int>() * 64);
}

TEST_F(Bake, VerticesWithoutNormalGetZeroAndAreCounted) {
  const std::string scene =
      write_file("loose.ply", ply_bytes({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}}, {{0, 1, 2}}));
  const ProgramResult result = run_program(bake(scene));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "lkao: " + scene + ": 1 vertex without a usable normal gets occlusion 0\n");
  EXPECT_EQ(read_json("out.json")["vertices_without_normal"], 1);
  EXPECT_EQ(read_json("out.json")["receivers"], 3);
  EXPECT_EQ(occlusion(3), 0);
}

TEST_F(Bake, CornersSplitVerticesAndFacesDoNot) {
  // A step: its top under a roof, its side beside it.
  const std::string scene = write_file(
      "step.ply",
      ply_bytes({{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {0, -1, 0}, {0, -1, 1}, {-9, 0.5f, -9}, {9, 0.5f, -9}, {0, 0.5f, 9}},
                {{0, 1, 2}, {1, 0, 3}, {1, 3, 4}, {5, 6, 7}}));
  expect_success(bake(scene));
  EXPECT_EQ(read_json("out.json")["vertices"], 8);
  const float mixed = occlusion(0);
  expect_success(bake(scene, {"--per", "corner"}));
  EXPECT_EQ(read_json("out.json")["vertices"], 10);
  EXPECT_EQ(read_json("out.json")["per"], "corner");
  EXPECT_GT(occlusion(0), mixed + 0.05f);
  EXPECT_LT(occlusion(8), mixed - 0.05f);
  EXPECT_EQ(scene::load(path("out.ply")).triangles.size(), 4u);

  expect_success(bake(scene, {"--per", "face"}));
  EXPECT_EQ(read_json("out.json")["vertices"], 8);
  EXPECT_NE(read_file("out.ply").find("vertex_indices\nproperty float occlusion\n"), std::string::npos);
  EXPECT_EQ(scene::load(path("out.ply")).triangles, scene::load(scene).triangles);
}

TEST_F(Bake, LeastSquaresFitsTheFaces) {
  const std::string scene = write_file("square.ply", roofed_square_ply());
  expect_success(bake(scene));
  const std::string plain = read_file("out.ply");
  expect_success(bake(scene, {"--filter", "least-squares"}));
  EXPECT_TRUE(read_file("out.ply") != plain);
  EXPECT_EQ(read_json("out.json")["filter"], "least-squares");
  EXPECT_GE(read_json("out.json")["receivers"], 12);
}

TEST_F(Bake, WritesObjWithColours) {
  const std::string scene = write_file("square.ply", roofed_square_ply());
  expect_success(bake_to("out.obj", scene, {"--linear"}));
  const std::string text = read_file("out.obj");
  EXPECT_EQ(text.substr(0, 9), "v -1 0 -1");
  EXPECT_NE(text.find("\nf 1 3 2\nf 1 4 3\nf 5 6 7\n"), std::string::npos);
  EXPECT_EQ(scene::load(path("out.obj")).triangles, scene::load(scene).triangles);
}

TEST_F(Bake, QualityIsAProperty) {
  expect_success(bake("builtin:wall", {"--quality"}));
  EXPECT_NE(read_file("out.ply").find("property uchar blue\nproperty float quality\n"), std::string::npos);
}

// The same table at zero and on the globe, where floats step by half a unit.
TEST_F(Bake, FarFromZeroNamesTheOrigin) {
  const auto table_obj = [](double x, double y) {
    std::string text;
    for (const auto& [dx, dy, z] : {std::array{0.1, 0.1, 0.0},
                                    {0.9, 0.1, 0.0},
                                    {0.9, 0.9, 0.0},
                                    {0.1, 0.9, 0.0},
                                    {0.1, 0.1, 0.3},
                                    {0.9, 0.1, 0.3},
                                    {0.9, 0.9, 0.3},
                                    {0.1, 0.9, 0.3}}) {
      text += fmt::format("v {:.10f} {:.10f} {}\n", x + dx, y + dy, z);
    }
    return text + "f 1 2 3\nf 1 3 4\nf 5 6 7\nf 5 7 8\n";
  };
  expect_success(bake_to("out.ply", write_file("near.obj", table_obj(0, 0)), {"--samples", "1024"}));
  std::vector<float> near;
  for (std::size_t k = 0; k < 8; ++k) near.push_back(occlusion(k));
  const ProgramResult result =
      run_program(bake_to("out.ply", write_file("far.obj", table_obj(5e5, 5e6)), {"--samples", "1024"}));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.err.find("coordinates are less the origin"), std::string::npos) << result.err;
  EXPECT_NE(read_file("out.ply").find("\ncomment origin 5"), std::string::npos);
  for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(occlusion(k), near[k], 0.01) << k;
  EXPECT_EQ(run_program(bake_to("out.obj", path("far.obj"))).exit_code, 0);
  EXPECT_EQ(read_file("out.obj").substr(0, 10), "v 500000.1");
}

TEST_F(Bake, OptionsThatDoNotMeetAreRefused) {
  expect_rejected(bake_to("out.stl", "builtin:wall"), {".ply, .obj, .gltf or .glb", "out.stl"});
  expect_rejected(bake_to("out.obj", "builtin:wall", {"--quality"}), {"--quality"});
  expect_rejected(bake_to("out.obj", "builtin:wall", {"--per", "face"}), {"--per face", ".obj"});
  expect_rejected(bake("builtin:wall", {"--per", "face", "--filter", "least-squares"}), {"--filter", "--per face"});
  expect_rejected(bake("builtin:wall", {"--per", "edge"}), {"--per", "vertex or corner or face", "edge"});
  expect_rejected(bake("builtin:wall", {"--normals", "file"}), {"--normals file", "builtin:wall"});
}

TEST_F(Bake, OneSidedIgnoresBacks) {
  // Seen from the square below, the roof shows its back.
  const std::string scene = write_file(
      "back.ply", ply_bytes({{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-5, 0.1f, -5}, {9, 0.1f, -5}, {-5, 0.1f, 9}},
                            {{0, 2, 1}, {3, 5, 4}}));
  expect_success(bake(scene, {"--sided", "two"}));
  EXPECT_GT(occlusion(0), 0.9f);
  expect_success(bake(scene, {"--sided", "one"}));
  EXPECT_EQ(occlusion(0), 0);
}

TEST_F(Bake, ThreadsDoNotChangeABit) {
  const auto bake_on = [&](const char* threads) {
    const char* const samples = tests::unless_sanitized<const char*>("64", "8");
    expect_success(bake_to("out.ply", "builtin:sphere", {"--samples", samples, "--threads", threads}));
    return read_file("out.ply");
  };
  EXPECT_TRUE(bake_on("2") == bake_on("1"));
}

}  // namespace
}  // namespace lkao::test
