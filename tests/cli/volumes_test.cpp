// lkao render --method volumes: drawn by OpenGL on the CPU, without rays.
#include <algorithm>
#include <cstdlib>
#include <memory>
#include <stdexcept>

#include "cli/gl_program.h"
#include "cli/small_mesh.h"
#include "image/image.h"
#include "image/metrics.h"
#include "lkao/gl.h"

namespace lkao::test {
namespace {

class VolumesRender : public GlProgramTest {
 protected:
  Arguments render(const Arguments& more = {}, const std::string& method = "volumes") const {
    return render_small_scene(method, "64x48", method, more);
  }

  std::vector<float> occlusion(const Arguments& more) const {
    Arguments arguments = {"--falloff", "linear"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_success(render(arguments));
    return image::read_image(path("volumes.exr")).pixels;
  }

  static double mean(const std::vector<float>& values) {
    double sum = 0;
    for (const float value : values) sum += static_cast<double>(value);
    return sum / static_cast<double>(values.size());
  }
};

TEST_F(VolumesRender, AreNearTheRaysOfLinearFalloff) {
  const ProgramResult result =
      expect_success(render({"--falloff", "linear", "--reference", "--samples", "1024", "--compensation", "none"}));
  const nlohmann::json json = read_json("volumes.json");
  EXPECT_EQ(json["method"], "volumes");
  EXPECT_EQ(json["falloff"], "linear");
  EXPECT_EQ(json["rays"], 0);
  EXPECT_EQ(json["invalid_receivers"], 0);
  EXPECT_GT(json["occlusion_mean"], 0.02);
  EXPECT_LT(json["reference"]["mae"], 0.05);
  EXPECT_TRUE(json["reference"]["ray_mismatch_rate"].is_null());
  const nlohmann::json volumes = json["volumes"];
  EXPECT_NEAR(volumes["delta"].get<double>(), 0.3, 1e-6);
  EXPECT_EQ(volumes["clamp"], "on");
  EXPECT_EQ(volumes["accessibility"], "16");
  EXPECT_EQ(volumes["volumes"], "every_frame");
  EXPECT_GT(volumes["fragments"], volumes["fragments_inside"]);
  EXPECT_GT(volumes["fragments_inside"], volumes["fragments_blended"]);
  EXPECT_EQ(json["gl"]["geometry"], "vertex_pulling");
  EXPECT_NE(result.out.find("fragments a receiver"), std::string::npos) << result.out;
}

TEST_F(VolumesRender, EverySettingDoesWhatItSays) {
  const std::vector<float> usual = occlusion({});
  EXPECT_EQ(occlusion({"--volumes", "kept", "--geometry", "geometry_shader"}), usual);
  EXPECT_GT(mean(occlusion({"--delta", "1"})), mean(usual));
  EXPECT_GT(mean(occlusion({"--clamp", "off"})), mean(usual));
  EXPECT_LT(mean(occlusion({"--accessibility", "8"})), mean(usual));
  EXPECT_LT(mean(occlusion({"--compensation", "fitted"})), mean(usual));
  EXPECT_NEAR(mean(occlusion({"--opacity", "0.5"})), 0.5 * mean(usual), 0.1 * mean(usual));
  EXPECT_EQ(mean(occlusion({"--opacity", "0"})), 0);
  EXPECT_LT(mean(occlusion({"--sided", "one"})), mean(usual));
  EXPECT_NE(occlusion({"--normals", "smooth"}), usual);
}

TEST_F(VolumesRender, WhatOnlyRaysCanDoIsRefused) {
  expect_rejected(render(), {"--falloff constant", "--method volumes"});
  expect_rejected(render({"--falloff", "smooth"}), {"--falloff smooth", "--method volumes"});
  const auto refused = [&](const Arguments& more, const std::vector<std::string>& words) {
    Arguments arguments = {"--falloff", "linear"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_rejected(render(arguments), words);
  };
  refused({"--weighting", "uniform"}, {"--weighting uniform", "--method volumes"});
  refused({"--min-distance", "0.1"}, {"--min-distance", "--method volumes"});
  refused({"--bent-normals"}, {"--bent-normals", "--method volumes"});
  refused({"--lod", "k=3"}, {"--lod", "--method volumes"});
  refused({"--kernel", "simd"}, {"--kernel", "--method volumes"});
  refused({"--delta", "0"}, {"--delta", "0.01"});
  Arguments endless = render({"--falloff", "linear"});
  *std::find(endless.begin(), endless.end(), "0.5") = "inf";
  expect_rejected(endless, {"--radius inf", "--method volumes"});
  expect_rejected(render({"--delta", "1"}, "bvh"), {"--delta", "--method volumes", "--method bvh"});
}

}  // namespace
}  // namespace lkao::test
