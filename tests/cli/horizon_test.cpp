// lkao render --method gtao and vbao: what the depth buffer blocks, drawn by OpenGL on the CPU.
#include <algorithm>
#include <string>
#include <vector>

#include "cli/gl_program.h"
#include "image/image.h"

namespace lkao::test {
namespace {

class HorizonRender : public GlProgramTest {
 protected:
  Arguments render(const std::string& method, const std::string& name, const Arguments& more = {}) const {
    return render_small_scene(method, "33x25", name, more);
  }
  std::vector<float> pixels(const std::string& name) const { return image::read_image(path(name + ".exr")).pixels; }
};

TEST_F(HorizonRender, BothAreNearRays) {
  for (const std::string method : {"gtao", "vbao"}) {
    SCOPED_TRACE(method);
    expect_success(render(method, method, {"--reference", "--filter", "0"}));
    const nlohmann::json json = read_json(method + ".json");
    EXPECT_EQ(json["method"], method);
    EXPECT_EQ(json["slices"], 2);
    EXPECT_EQ(json["slice_steps"], 16);
    EXPECT_EQ(json["thickness"].is_null(), method == "gtao");
    EXPECT_GT(json["occlusion_mean"], 0.01);
    EXPECT_LT(json["reference"]["mae"], 0.15);
    expect_success(render(method, "converged", {"--reference", "--converged", "--guard-band", "8"}));
    const nlohmann::json converged = read_json("converged.json");
    EXPECT_EQ(converged["converged"], true);
    EXPECT_EQ(converged["slices"], 256);
    EXPECT_LT(converged["reference"]["rmse"], json["reference"]["rmse"]);
  }
}

TEST_F(HorizonRender, EverySettingChangesThePicture) {
  // Fewer steps than there are pixels within the radius.
  const auto expect_changes = [this](const std::string& method, const std::vector<Arguments>& all) {
    expect_success(render(method, "usual", {"--slice-steps", "4"}));
    const std::vector<float> usual = pixels("usual");
    for (const Arguments& more : all) {
      SCOPED_TRACE(method + ' ' + testing::PrintToString(more));
      Arguments arguments = render(method, "other", more);
      if (more[0] != "--slice-steps") arguments.insert(arguments.end(), {"--slice-steps", "4"});
      expect_success(arguments);
      EXPECT_NE(pixels("other"), usual);
    }
  };
  expect_changes("gtao", {{"--slices", "3"},
                          {"--slice-steps", "2"},
                          {"--step-exponent", "1"},
                          {"--screen-radius", "2"},
                          {"--slice-density", "even"},
                          {"--falloff-begin", "0.3"},
                          {"--angle-bias", "0.4"},
                          {"--seed", "3"},
                          {"--sinking", "0.2"}});
  expect_changes("vbao", {{"--thickness", "0.02"}, {"--sector-measure", "angle"}, {"--falloff", "linear"}});
}

TEST_F(HorizonRender, WhatTheyCannotDoIsRefused) {
  expect_rejected(render("gtao", "a", {"--falloff", "linear"}), {"--falloff linear", "--method gtao"});
  expect_rejected(render("vbao", "a", {"--falloff", "smooth"}), {"--falloff smooth", "--method vbao"});
  expect_rejected(render("vbao", "a", {"--falloff", "linear", "--falloff-begin", "0.5"}), {"--falloff-begin"});
  expect_rejected(render("gtao", "a", {"--thickness", "0.5"}), {"--thickness", "--method vbao"});
  expect_rejected(render("vbao", "a", {"--sinking", "0.5"}), {"--sinking", "--method gtao"});
  expect_rejected(render("vbao", "a", {"--sector-measure", "wide"}), {"--sector-measure", "cosine or angle"});
  expect_rejected(render("gtao", "a", {"--slices", "513"}), {"--slices", "'513'"});
  expect_rejected(render("gtao", "a", {"--converged", "--slices", "4"}), {"--converged", "--slices"});
  expect_rejected(render("gtao", "a", {"--slices", "200", "--slice-steps", "200"}), {"slice", "200"});
}

}  // namespace
}  // namespace lkao::test
