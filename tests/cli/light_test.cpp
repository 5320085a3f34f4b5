// Soft shadows: lkao render --light.
#include <algorithm>
#include <cmath>

#include "cli/program.h"
#include "cli/small_mesh.h"
#include "image/image.h"

namespace lkao::test {
namespace {

// A square on the floor under a triangle that covers half of it, seen from the side.
class Light : public ProgramTest {
 protected:
  Arguments roofed(const std::string& light, const Arguments& more) const {
    const std::string scene = write_file("roofed.ply", roofed_square_ply());
    Arguments arguments = {"render",  scene,      "--size", "48x36",   "--samples", "64",       "--eye",
                           "0.3,2,3", "--target", "0,0,0",  "--light", light,       "--output", path("out.exr")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  std::vector<float> channel(const std::string& file, const std::string& name) const {
    const image::Image image = image::read_image(path(file));
    const int place = image.channel(name);
    EXPECT_GE(place, 0) << name;
    std::vector<float> values;
    values.reserve(image.pixels.size());
    for (auto i = static_cast<std::size_t>(place); i < image.pixels.size();
         i += static_cast<std::size_t>(image.channel_count())) {
      values.push_back(image.pixels[i]);
    }
    return values;
  }
};

constexpr const char* kSphere = "0,3,0,0.3";
constexpr const char* kDisc = "0,3,0,0.3,0,-1,0";

TEST_F(Light, TheImageHoldsVisibility) {
  for (const char* light : {kSphere, kDisc}) {
    const ProgramResult result =
        expect_success(roofed(light, {"--depth", "--json", path("out.json"), "--preview", path("out.png")}));
    EXPECT_NE(result.out.find("mean visibility"), std::string::npos) << result.out;
    const std::vector<float> visibility = channel("out.exr", "visibility"), depth = channel("out.exr", "depth.Z");
    EXPECT_EQ(image::read_image(path("out.exr")).channel("occlusion"), -1);
    double sum = 0;
    int count = 0, lit_count = 0, umbra_count = 0, penumbra_count = 0;
    for (std::size_t i = 0; i < visibility.size(); ++i) {
      if (std::isinf(depth[i])) {
        EXPECT_EQ(visibility[i], 1) << "the background";
        continue;
      }
      sum += static_cast<double>(visibility[i]);
      ++count;
      lit_count += visibility[i] == 1;
      umbra_count += visibility[i] == 0;
      penumbra_count += visibility[i] > 0 && visibility[i] < 1;
    }
    EXPECT_GT(lit_count, 50);
    EXPECT_GT(umbra_count, 50);
    EXPECT_GT(penumbra_count, 5);
    const nlohmann::json json = read_json("out.json");
    EXPECT_NEAR(json["visibility_mean"].get<double>(), sum / count, 1e-6);
    EXPECT_NEAR(json["occlusion_mean"].get<double>(), 1 - sum / count, 1e-6);
    EXPECT_TRUE(json["radius"].is_null());
    EXPECT_NEAR(json["light"]["radius"].get<double>(), 0.3, 1e-6);
    EXPECT_EQ(json["light"]["position"], nlohmann::json({0.0, 3.0, 0.0}));
    EXPECT_EQ(json["light"].contains("normal"), std::string(light) == kDisc);
  }
}

TEST_F(Light, EveryMethodThatTakesItSeesTheSame) {
  expect_success(roofed(kSphere, {"--reference", "--json", path("out.json")}));
  EXPECT_EQ(read_json("out.json")["reference"]["mismatched_rays"], 0);
  const std::vector<float> expected = channel("out.exr", "visibility");
  for (const Arguments& method : {Arguments{"--kernel", "scalar"}, Arguments{"--method", "embree"}}) {
    expect_success(roofed(kSphere, method));
    EXPECT_EQ(channel("out.exr", "visibility"), expected) << method[1];
  }
}

// The preview is white where all of the light is seen and black where nothing of it is.
TEST_F(Light, ThePreviewShowsIt) {
  expect_success(roofed(kDisc, {"--preview", path("out.png")}));
  const std::vector<float> visibility = channel("out.exr", "visibility"), red = channel("out.png", "R");
  int black_count = 0;
  for (std::size_t i = 0; i < red.size(); ++i) {
    if (visibility[i] != 0) continue;
    EXPECT_EQ(red[i], 0) << i;
    ++black_count;
  }
  EXPECT_GT(black_count, 50);
  EXPECT_EQ(*std::max_element(red.begin(), red.end()), 1);
}

TEST_F(Light, WhatHasNoUseForItIsRefused) {
  const auto refuse = [&](const Arguments& more, const std::vector<std::string>& words) {
    expect_rejected(roofed(kSphere, more), words);
  };
  refuse({"--radius", "1"}, {"--light has no use for --radius"});
  refuse({"--falloff", "linear"}, {"--light has no use for --falloff"});
  refuse({"--weighting", "uniform"}, {"--light has no use for --weighting"});
  refuse({"--min-distance", "0.1"}, {"--light has no use for --min-distance"});
  refuse({"--lod", "k=3"}, {"--light has no use for --lod"});
  refuse({"--bent-normals"}, {"--light has no use for --bent-normals"});
  refuse({"--kernel", "table"}, {"--light is for --kernel simd and scalar, not for --kernel table"});
}

TEST_F(Light, ABadOneIsNamed) {
  for (const char* light : {"1,2,3", "1,2,3,4,5", "1,2,3,4,5,6,7,8", "one", ""}) {
    expect_rejected(roofed(light, {}), {"--light", "expected x,y,z,radius of a sphere"});
  }
  expect_rejected(roofed("1,2,x,4", {}), {"--light", "three finite numbers"});
  expect_rejected(roofed("1,2,3,0", {}), {"--light", "above 0"});
  expect_rejected(roofed("1,2,3,1,0,0,0", {}), {"--light", "normal of a disc"});
  expect_rejected(roofed("1e20,2,3,1", {}), {"light.position must be within 1e17"});
}

}  // namespace
}  // namespace lkao::test
