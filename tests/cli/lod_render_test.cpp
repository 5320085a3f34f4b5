// lkao render --lod: levels of detail by the query, made on the fly or loaded.
#include "cli/program.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace lkao::test {
namespace {

class LodRender : public ProgramTest {
 protected:
  Arguments render(const Arguments& more) const {
    Arguments arguments = {"render", "builtin:disk", "--size", "32x24",        "--radius",   "2",
                           "-o",     path("a.exr"),  "--json", path("a.json"), "--reference"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  nlohmann::json rendered(const Arguments& more) {
    expect_success(render(more));
    return read_json("a.json");
  }
};

TEST_F(LodRender, IsNearTheSceneAndSaysHowNear) {
  const nlohmann::json json = rendered({"--lod", "k=2,levels=3"});
  ASSERT_EQ(json["lod"]["levels"].size(), 3u);
  EXPECT_EQ(json["lod"]["k"], 2);
  EXPECT_EQ(json["lod"]["levels"][0]["r_min"], 0);
  EXPECT_NEAR(json["lod"]["levels"][2]["r_min"].get<double>(), 1.0, 1e-6);  // half of the radius
  EXPECT_LT(json["lod"]["levels"][2]["triangles"], json["lod"]["levels"][0]["triangles"]);
  EXPECT_LT(json["reference"]["mae"].get<double>(), 0.03);
}

TEST_F(LodRender, TakesAnInfiniteRadius) {
  const auto render = [&](const Arguments& more) {
    Arguments arguments = {"render", "builtin:disk", "--size", "32x24",        "--radius",   "inf",
                           "-o",     path("a.exr"),  "--json", path("a.json"), "--reference"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_success(arguments);
    return read_json("a.json");
  };
  const nlohmann::json info = nlohmann::json::parse(expect_success({"info", "builtin:disk", "--json", "-"}).out);
  const nlohmann::json json = render({"--lod", "k=2,levels=3"});
  EXPECT_NEAR(json["lod"]["levels"][2]["r_min"].get<double>(), info["diagonal"].get<double>() / 2, 1e-5);
  EXPECT_LT(json["reference"]["mae"].get<double>(), 0.03);
  EXPECT_EQ(render({"--lod", "k=1000000,epsilon=0.1"})["reference"]["mismatched_rays"], 0);
}

// Levels that save too little, or begin behind all rays, are there but not used.
TEST_F(LodRender, SaysWhichLevelsAreInUse) {
  const auto in_use = [](const nlohmann::json& json) {
    std::vector<bool> result;
    for (const nlohmann::json& level : json["lod"]["levels"]) result.push_back(level["in_use"]);
    return result;
  };
  EXPECT_EQ(in_use(rendered({"--lod", "k=2,levels=3"})).front(), true);
  EXPECT_EQ(in_use(rendered({"--lod", "k=1000000,levels=3,epsilon=0.1"})), std::vector({true, false, false}));
}

// Levels that begin behind all rays: nothing is different.
TEST_F(LodRender, ConvergesToTheScene) {
  const nlohmann::json json = rendered({"--lod", "k=1000000,epsilon=0.1"});
  EXPECT_EQ(json["reference"]["mismatched_rays"], 0);
}

TEST_F(LodRender, TakesTheFileOfSimplify) {
  const nlohmann::json made = rendered({"--lod", "levels=2,epsilon=0.05"});
  expect_success({"simplify", "builtin:disk", "-o", path("chain.json"), "--levels", "2", "--epsilon", "0.05"});
  const nlohmann::json loaded = rendered({"--lod", path("chain.json")});
  EXPECT_EQ(loaded["lod"]["levels"], made["lod"]["levels"]);
  EXPECT_EQ(loaded["reference"]["mismatched_rays"], made["reference"]["mismatched_rays"]);

  expect_rejected(
      {"render", "builtin:wall", "--radius", "1", "--size", "8x8", "-o", path("b.exr"), "--lod", path("chain.json")},
      {"another mesh"});
}

TEST_F(LodRender, BadInputIsOneLine) {
  const std::pair<Arguments, const char*> mistakes[] = {{{"--lod", "k=0"}, "--lod: expected"},
                                                        {{"--lod", "levels=99"}, "99"},
                                                        {{"--lod", "depth=3"}, "depth"},
                                                        {{"--lod", "k"}, "'k'"},
                                                        {{"--lod", "growth=1"}, "growth"},
                                                        {{"--lod", path("nowhere.json")}, "nowhere.json"},
                                                        {{"--lod", "k=3", "--kernel", "table"}, "--kernel table"},
                                                        {{"--lod", "k=3", "--method", "embree"}, "--method embree"}};
  for (const auto& [arguments, named] : mistakes) {
    expect_rejected(render(arguments), {named});
  }
}

}  // namespace
}  // namespace lkao::test
