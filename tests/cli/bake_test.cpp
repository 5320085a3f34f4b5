#include <cstring>

#include "cli/program.h"
#include "cli/small_mesh.h"
#include "scene/load.h"

namespace lkao::test {
namespace {

class Bake : public ProgramTest {
 protected:
  Arguments bake(const std::string& scene, const Arguments& more = {}) const {
    Arguments arguments = {"bake", scene,       "-o", path("out.ply"), "--radius",
                           "5",    "--samples", "64", "--json",        path("out.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
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
  EXPECT_EQ(read_json("out.json")["receivers"], 7);
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
  expect_success(bake("builtin:sphere", {"--threads", "1"}));
  const std::string one = read_file("out.ply");
  expect_success(bake("builtin:sphere", {"--threads", "2"}));
  EXPECT_TRUE(read_file("out.ply") == one);
}

}  // namespace
}  // namespace lkao::test
