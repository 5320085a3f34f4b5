// lkao render --method alchemy: obscurance of what the camera sees, drawn by OpenGL on the CPU.
#include <algorithm>
#include <string>
#include <vector>

#include "cli/gl_program.h"
#include "image/image.h"

namespace lkao::test {
namespace {

class AlchemyRender : public GlProgramTest {
 protected:
  Arguments render(const std::string& name, const Arguments& more = {}) const {
    return render_small_scene("alchemy", "33x25", name, more);
  }

  std::vector<float> pixels(const std::string& name) const { return image::read_image(path(name + ".exr")).pixels; }
};

TEST_F(AlchemyRender, IsNearRaysWithLessThanThePapersIntensity) {
  expect_success(render("usual", {"--reference"}));
  expect_success(render("lighter", {"--reference", "--alchemy-intensity", "0.7", "--converged"}));
  const nlohmann::json usual = read_json("usual.json"), lighter = read_json("lighter.json");
  EXPECT_EQ(usual["method"], "alchemy");
  EXPECT_EQ(usual["rays"], 0);
  EXPECT_EQ(usual["invalid_receivers"], 0);
  EXPECT_EQ(usual["alchemy"]["intensity"], 2);
  EXPECT_EQ(usual["alchemy"]["falloff"], "cut_off");
  EXPECT_EQ(usual["alchemy"]["pattern"], "jittered");
  EXPECT_EQ(usual["alchemy"]["samples"], 4);
  EXPECT_GT(usual["occlusion_mean"], 0.02);
  EXPECT_EQ(lighter["converged"], true);
  EXPECT_EQ(lighter["filter"], 0);
  EXPECT_GT(lighter["alchemy"]["samples"], 4000);
  EXPECT_TRUE(lighter["reference"]["mismatched_rays"].is_null());
  EXPECT_LT(lighter["reference"]["mae"], 0.12);
}

TEST_F(AlchemyRender, EverySettingChangesThePicture) {
  const Arguments spiral = {"--alchemy-pattern", "spiral", "--alchemy-full-radius", "2"};
  expect_success(render("usual", spiral));
  const std::vector<float> usual = pixels("usual");
  for (const Arguments& more : std::vector<Arguments>{{"--alchemy-intensity", "1"},
                                                      {"--alchemy-bias", "0.02"},
                                                      {"--alchemy-epsilon", "0.1"},
                                                      {"--alchemy-contrast", "2"},
                                                      {"--alchemy-falloff", "smooth"},
                                                      {"--alchemy-samples", "5"},
                                                      {"--alchemy-bands", "1"},
                                                      {"--alchemy-full-radius", "1000"},
                                                      {"--alchemy-pattern", "jittered"},
                                                      {"--alchemy-turns", "5"},
                                                      {"--guard-band", "12"},
                                                      {"--seed", "5"}}) {
    SCOPED_TRACE(testing::PrintToString(more));
    Arguments arguments = render("other", spiral);
    const auto given = std::find(arguments.begin(), arguments.end(), more[0]);
    if (given != arguments.end()) arguments.erase(given, given + 2);
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_success(arguments);
    EXPECT_NE(pixels("other"), usual);
  }
}

TEST_F(AlchemyRender, ConvergedPicturesOfEvenPatternsAreTheSame) {
  expect_success(render("jittered", {"--converged"}));
  for (const std::string pattern : {"even_spiral", "spiral"}) {
    expect_success(render(pattern, {"--converged", "--alchemy-pattern", pattern}));
    expect_success({"compare", path("jittered.exr"), path(pattern + ".exr"), "--json", path("difference.json")});
    const double rmse = read_json("difference.json")["rmse"];
    EXPECT_EQ(rmse < 0.01, pattern == "even_spiral") << rmse;
  }
}

TEST_F(AlchemyRender, WhatItCannotDoIsRefused) {
  const std::vector<Arguments> all = {{"--falloff", "linear"},   {"--weighting", "uniform"}, {"--sided", "one"},
                                      {"--min-distance", "0.1"}, {"--lod", "k=3"},           {"--bent-normals"}};
  for (const Arguments& more : all) expect_rejected(render("a", more), {more[0], "--method alchemy"});
  expect_rejected(render("a", {"--alchemy-samples", "0"}), {"--alchemy-samples", "'0'"});
  expect_rejected(render("a", {"--alchemy-pattern", "grid"}), {"--alchemy-pattern", "jittered or spiral"});
  for (const std::string name : {"samples", "bands", "turns"}) {
    const std::string option = "--alchemy-" + name;
    expect_rejected(render("a", {"--converged", option, "3"}), {"--converged", option});
  }
}

TEST_F(AlchemyRender, HelpNamesItsSettings) {
  const std::string help = expect_success({"render", "--help"}).out;
  for (const char* word : {"Settings of alchemy", "--alchemy-intensity", "--alchemy-falloff", "--alchemy-pattern"}) {
    EXPECT_NE(help.find(word), std::string::npos) << word;
  }
}

}  // namespace
}  // namespace lkao::test
