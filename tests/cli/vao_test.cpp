// lkao render --method vao: volumetric ambient occlusion in screen space, drawn by OpenGL on the CPU.
#include <algorithm>
#include <cmath>
#include <memory>

#include "cli/gl_program.h"
#include "cli/small_mesh.h"
#include "image/image.h"
#include "lkao/gl.h"

namespace lkao::test {
namespace {

class VaoRender : public GlProgramTest {
 protected:
  // So large a picture and so small a radius that some tiles are open.
  Arguments render(const std::string& name, const Arguments& more = {}) const {
    Arguments arguments = render_small_scene("vao", "120x90", name, more);
    *(std::find(arguments.begin(), arguments.end(), "--radius") + 1) = "0.1";
    return arguments;
  }

  std::vector<float> pixels(const std::string& name) const { return image::read_image(path(name + ".exr")).pixels; }
};

TEST_F(VaoRender, SeesSomethingOfWhatRaysFind) {
  expect_success(render("a", {"--reference"}));
  const nlohmann::json json = read_json("a.json");
  EXPECT_EQ(json["method"], "vao");
  EXPECT_EQ(json["rays"], 0);
  EXPECT_EQ(json["invalid_receivers"], 0);
  EXPECT_EQ(json["vao"]["samples"], 16);
  EXPECT_EQ(json["vao"]["culling"], "careful");
  EXPECT_GT(json["culled_share"], 0);
  EXPECT_LT(json["culled_share"], 1);
  EXPECT_GT(json["vao"]["samples_per_pixel"], 1);
  EXPECT_LT(json["vao"]["samples_per_pixel"], 17);
  EXPECT_GT(json["occlusion_mean"], 0.005);
  EXPECT_LT(json["reference"]["mae"], 0.2);
}

TEST_F(VaoRender, EverySettingChangesThePicture) {
  expect_success(render("usual"));  // and --converged: below
  const std::vector<float> usual = pixels("usual");
  for (const Arguments& more : {Arguments{"--vao-samples", "8"},
                                {"--vao-fewest-width", "1"},
                                {"--vao-culling", "off"},
                                {"--vao-culling", "greedy"},
                                {"--vao-thickness", "0"},
                                {"--vao-width", "2"},
                                {"--step", "2"},
                                {"--guard-band", "8"}}) {
    SCOPED_TRACE(testing::PrintToString(more));
    expect_success(render("other", more));
    EXPECT_NE(pixels("other"), usual);
  }
}

TEST_F(VaoRender, OfManySamplesIsNearWhatItConvergesTo) {
  expect_success(render("limit", {"--converged"}));
  const Arguments full = {"--vao-samples", "32", "--vao-culling", "off", "--vao-fewest-width", "0", "--filter", "0"};
  expect_success(render("full", full));
  const std::vector<float> limit = pixels("limit"), drawn = pixels("full");
  double squares = 0;
  for (std::size_t i = 0; i < limit.size(); ++i)
    squares += static_cast<double>((limit[i] - drawn[i]) * (limit[i] - drawn[i]));
  EXPECT_LT(std::sqrt(squares / static_cast<double>(limit.size())), 0.03);
  EXPECT_NE(limit, drawn);
  const nlohmann::json json = read_json("limit.json");
  EXPECT_EQ(json["converged"], true);
  EXPECT_EQ(json["culled_share"], 0);
  EXPECT_GT(json["vao"]["samples_per_pixel"], 2000);
}

TEST_F(VaoRender, WhatItCannotDoIsRefused) {
  const std::vector<Arguments> all = {{"--falloff", "linear"},   {"--weighting", "uniform"}, {"--sided", "one"},
                                      {"--min-distance", "0.1"}, {"--lod", "k=3"},           {"--bent-normals"}};
  for (const Arguments& more : all) expect_rejected(render("a", more), {more[0], "--method vao"});
  expect_rejected(render("a", {"--vao-samples", "12"}), {"--vao-samples", "16"});
  expect_rejected(render("a", {"--vao-culling", "none"}), {"--vao-culling", "off or greedy or careful"});
  expect_rejected(render("a", {"--vao-thickness", "-1"}), {"--vao-thickness", "-1"});
  expect_rejected(render("a", {"--converged", "--vao-samples", "8"}), {"--converged", "--vao-samples"});
}

}  // namespace
}  // namespace lkao::test
