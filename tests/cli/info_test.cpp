#include <limits>

#include "cli/program.h"
#include "cli/small_mesh.h"

namespace lkao::test {
namespace {

class Info : public ProgramTest {
 protected:
  nlohmann::json info(const std::string& scene) const {
    return nlohmann::json::parse(expect_success({"info", scene, "--json", "-"}).out);
  }
};

TEST_F(Info, CountsDefects) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::string scene =
      write_file("bad.ply", ply_bytes({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {6, 0, 0}, {nan, 0, 0}, {7, 7, 7}},
                                      {{0, 1, 2}, {2, 0, 1}, {0, 1, 3}, {0, 0, 2}, {1, 1, 1}, {0, 1, 4}}));
  const nlohmann::json json = info(scene);
  EXPECT_EQ(json["triangles"], 6);
  EXPECT_EQ(json["vertices"], 6);
  EXPECT_EQ(json["defects"]["zero_area"], 3);
  EXPECT_EQ(json["defects"]["non_finite"], 1);
  EXPECT_EQ(json["defects"]["duplicate"], 1);
  EXPECT_EQ(json["defects"]["unused_vertices"], 1);
}

TEST_F(Info, ShowsBoundsAndSuggestsRadii) {
  const std::string scene = write_file("square.ply", ply_bytes({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}));
  const nlohmann::json json = info(scene);
  EXPECT_EQ(json["bounds"]["lower"], nlohmann::json({0, 0, 0}));
  EXPECT_EQ(json["bounds"]["upper"], nlohmann::json({3, 4, 0}));
  EXPECT_EQ(json["diagonal"], 5);
  EXPECT_NEAR(json["suggested_radii"]["small"], 0.07, 1e-6);  // 1.4 % of 5
  EXPECT_NEAR(json["suggested_radii"]["large"], 0.21, 1e-6);  // 4.2 % of 5
  EXPECT_NEAR(json["suggested_radii"]["small_percent"], 1.4, 1e-5);
  EXPECT_NEAR(json["suggested_radii"]["large_percent"], 4.2, 1e-5);
  const std::string row =
      "0.07 (small, 1.4 % of the diagonal), 0.21 (large, 4.2 % of the diagonal), in the file's unit\n";
  EXPECT_NE(expect_success({"info", scene}).out.find(row), std::string::npos);
}

TEST_F(Info, TellsWhatComesWithTheTriangles) {
  const std::string bare = write_file("bare.obj", "v 0 0 0\nv 3 0 0\nv 0 4 0\nf 1 2 3\n");
  EXPECT_EQ(info(bare)["normals"], (nlohmann::json{{"count", 0}, {"corners_without", 3}}));
  const nlohmann::json json = info("builtin:disk");
  EXPECT_EQ(json["origin"], nlohmann::json({0, 0, 0}));
  for (const char* key : {"nodes", "instances", "hidden_nodes", "uv_sets", "cut_out_triangles"}) {
    EXPECT_EQ(json[key], 0) << key;
  }
  EXPECT_EQ(json["remarks"], nlohmann::json::array());
}

TEST_F(Info, ASceneWithoutAnyFinitePointHasNoBounds) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const nlohmann::json json = info(write_file("nan.ply", ply_bytes({{nan, 0, 0}}, {{0, 0, 0}})));
  EXPECT_TRUE(json["bounds"].is_null());
  EXPECT_TRUE(json["suggested_radii"].is_null());
  EXPECT_EQ(json["defects"]["non_finite"], 1);
}

TEST_F(Info, TheTableSaysTheSame) {
  const std::string scene = write_file("square.ply", roofed_square_ply());
  const std::string table = expect_success({"info", scene}).out;
  for (const char* row : {"triangles             3\n", "vertices              7\n", "(-1, 0, -1) .. (1, 0.5, 1)",
                          "zero-area triangles   0\n"}) {
    EXPECT_NE(table.find(row), std::string::npos) << row << table;
  }
}

TEST_F(Info, ListsTheBuiltinScenes) {
  const std::string list = expect_success({"info"}).out;
  EXPECT_EQ(expect_success({"info", "--list"}).out, list);
  for (const char* name : {"builtin:atrium", "builtin:city", "builtin:hairball", "builtin:plane", "builtin:box",
                           "builtin:wall", "builtin:disk", "builtin:sphere"}) {
    EXPECT_NE(list.find(name), std::string::npos) << name;
  }
}

TEST_F(Info, RejectsWhatIsNoScene) {
  expect_rejected({"info", path("nowhere.ply")}, {"nowhere.ply"});
  expect_rejected({"info", write_file("empty.obj", "")}, {"empty.obj"});
  expect_rejected({"info", "builtin:castle"}, {"castle"});
  expect_rejected({"info", "builtin:wall", "--list"}, {"--list"});
}

}  // namespace
}  // namespace lkao::test
