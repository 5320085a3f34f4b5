// lkao render --method splat: an approximation of the other methods' picture, drawn by OpenGL on the CPU.
#include <algorithm>
#include <cstdlib>
#include <memory>
#include <stdexcept>

#include "cli/gl_program.h"
#include "cli/small_mesh.h"
#include "image/image.h"
#include "lkao/gl.h"

namespace lkao::test {
namespace {

class SplatRender : public GlProgramTest {
 protected:
  Arguments render(const std::string& name, const Arguments& more = {}) const {
    Arguments settings = {"--spheres", "600"};
    settings.insert(settings.end(), more.begin(), more.end());
    return render_small_scene("splat", "33x25", name, settings);
  }

  std::vector<float> pixels(const std::string& name) const { return image::read_image(path(name + ".exr")).pixels; }
};

TEST_F(SplatRender, EachHalfSeesSomethingAndBothAreNearRays) {
  for (const std::string half : {"near", "far", "both"}) {
    SCOPED_TRACE(half);
    expect_success(render(half, {"--halves", half, "--reference"}));
    const nlohmann::json json = read_json(half + ".json");
    EXPECT_EQ(json["method"], "splat");
    EXPECT_EQ(json["halves"], half);
    EXPECT_EQ(json["rays"], 0);
    EXPECT_EQ(json["invalid_receivers"], 0);
    EXPECT_EQ(json.contains("near"), half != "far");
    EXPECT_EQ(json.contains("far"), half != "near");
    EXPECT_GT(json["occlusion_mean"], 0.005);
    EXPECT_TRUE(json["reference"]["mismatched_rays"].is_null());
    EXPECT_LT(json["reference"]["mae"], 0.2);
  }
  EXPECT_NEAR(read_json("near.json")["near"]["radius"], 0.5, 1e-6);
  EXPECT_NEAR(read_json("both.json")["near"]["radius"], 0.125, 1e-6);
  EXPECT_GT(read_json("far.json")["far"]["fragments_per_pixel"], 1);
  EXPECT_GT(read_json("far.json")["far"]["spheres"], 500);
}

TEST_F(SplatRender, EverySettingChangesThePicture) {
  // The near half must reach several pixels.
  const Arguments wide = {"--near-share", "0.9"};
  expect_success(render("usual", wide));
  const std::vector<float> usual = pixels("usual");
  for (const Arguments& more : {Arguments{"--near-share", "0.5"},
                                {"--layers", "1"},
                                {"--near-samples", "5"},
                                {"--near-rate", "0.5"},
                                {"--near-density", "even"},
                                {"--pixel-sphere", "0.7"},
                                {"--spheres", "100"},
                                {"--lloyd-rounds", "0"},
                                {"--epsilon", "0.2"},
                                {"--formula", "printed"},
                                {"--formula", "exact"},
                                {"--inside", "everything"},
                                {"--seed", "5"},
                                {"--radius", "inf"}}) {
    SCOPED_TRACE(testing::PrintToString(more));
    Arguments arguments = render("other", wide);
    const auto given = std::find(arguments.begin(), arguments.end(), more[0]);
    if (given != arguments.end()) arguments.erase(given, given + 2);
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_success(arguments);
    EXPECT_NE(pixels("other"), usual);
  }
}

TEST_F(SplatRender, IsTheSameEveryTime) {
  expect_success(render("a", {"--threads", "1"}));
  expect_success(render("b", {"--threads", "2"}));
  EXPECT_EQ(pixels("a"), pixels("b"));
}

TEST_F(SplatRender, WhatItCannotDoIsRefused) {
  const std::vector<Arguments> all = {{"--falloff", "linear"},   {"--weighting", "uniform"}, {"--sided", "one"},
                                      {"--min-distance", "0.1"}, {"--lod", "k=3"},           {"--bent-normals"}};
  for (const Arguments& more : all) expect_rejected(render("a", more), {more[0], "--method splat"});
  expect_rejected(render("a", {"--masks", "exact"}), {"--masks", "--method raster", "--method splat"});
  expect_rejected(render("a", {"--near-samples", "2.5"}), {"--near-samples", "whole number", "2.5"});
  expect_rejected(render("a", {"--near-samples", "0"}), {"--near-samples", "'0'"});
  expect_rejected(render("a", {"--epsilon", "0"}), {"--epsilon", "'0'"});
  expect_rejected(render("a", {"--halves", "none"}), {"--halves", "near or far or both"});
}

TEST_F(SplatRender, HelpNamesItsSettings) {
  const std::string help = expect_success({"render", "--help"}).out;
  for (const char* word : {"Settings of splat", "--halves", "--near-share", "--epsilon", "--spheres", "--formula"}) {
    EXPECT_NE(help.find(word), std::string::npos) << word;
  }
}

}  // namespace
}  // namespace lkao::test
