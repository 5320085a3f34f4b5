#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>

#include "cli/program.h"
#include "cli/small_mesh.h"
#include "image/image.h"

namespace lkao::test {
namespace {

class Render : public ProgramTest {
 protected:
  Arguments wall(const Arguments& more) const {
    Arguments arguments = {"render", "builtin:wall", "--size", "32x24", "--samples", "64", "--radius", "0.5"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
};

TEST_F(Render, WritesAnImageAndATable) {
  const ProgramResult result = expect_success(wall({"-o", path("out.exr")}));
  EXPECT_EQ(files(), std::vector<std::string>{"out.exr"});
  const image::Image image = image::read_image(path("out.exr"));
  EXPECT_EQ(image.width, 32);
  EXPECT_EQ(image.height, 24);
  EXPECT_EQ(image.channels, std::vector<std::string>{"occlusion"});
  const auto [least, most] = std::minmax_element(image.pixels.begin(), image.pixels.end());
  EXPECT_EQ(*least, 0);    // far from the wall
  EXPECT_GT(*most, 0.2f);  // near its foot
  EXPECT_LE(*most, 1);
  for (const char* word : {"builtin:wall", "Mrays/s", "mean occlusion", "out.exr"}) {
    EXPECT_NE(result.out.find(word), std::string::npos) << word << "\n" << result.out;
  }
}

TEST_F(Render, JsonHasThePromisedKeys) {
  expect_success(wall({"-o", path("out.exr"), "--json", path("out.json"), "--reference"}));
  const nlohmann::json json = read_json("out.json");
  for (const char* key : {"method", "scene", "radius", "samples", "width", "height", "receivers", "rays", "seconds",
                          "mrays_per_second", "occlusion_mean", "load_seconds", "build_seconds", "reference"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["method"], "bvh");
  EXPECT_EQ(json["scene"], "builtin:wall");
  EXPECT_EQ(json["radius"], 0.5);
  EXPECT_EQ(json["samples"], 64);
  EXPECT_EQ(json["width"], 32);
  EXPECT_EQ(json["height"], 24);
  EXPECT_GT(json["receivers"], 0);
  EXPECT_LE(json["receivers"], 32 * 24);
  EXPECT_EQ(json["rays"], json["receivers"].get<int>() * 64);
  EXPECT_GT(json["seconds"], 0);
  EXPECT_NEAR(json["mrays_per_second"], json["rays"].get<double>() / json["seconds"].get<double>() / 1e6, 1e-6);
  for (const char* key : {"mismatched_rays", "ray_mismatch_rate", "mae", "rmse", "max_error", "seconds"}) {
    EXPECT_TRUE(json["reference"].contains(key)) << key;
  }
}

TEST_F(Render, AnInfiniteRadiusIsOneBeyondTheScene) {
  const auto render = [&](const std::string& radius, const Arguments& more) {
    Arguments arguments = {"render", "builtin:wall",   "--size",   "32x24", "--samples",  "64", "-o", path("out.exr"),
                           "--json", path("out.json"), "--radius", radius,  "--reference"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_success(arguments);
    EXPECT_EQ(read_json("out.json")["reference"]["mismatched_rays"], 0);
    return image::read_image(path("out.exr")).pixels;
  };
  // Powers of two, as the rays of an infinite radius are.
  const std::vector<float> expected = render("1024", {});
  EXPECT_EQ(render("inf", {}), expected);
  EXPECT_TRUE(read_json("out.json").at("radius").is_null());
  EXPECT_EQ(render("infinity", {"--kernel", "scalar"}), expected);
  EXPECT_EQ(render("inf", {"--kernel", "table"}), expected);
  EXPECT_EQ(render("inf", {"--method", "embree"}), expected);
  EXPECT_EQ(render("inf", {"--falloff", "linear"}), expected);  // a share of infinity is infinite
}

TEST_F(Render, ARadiusMayBeAShareOfTheDiagonal) {
  const nlohmann::json info = nlohmann::json::parse(expect_success({"info", "builtin:wall", "--json", "-"}).out);
  const auto render = [&](const std::string& radius, const std::string& name) {
    expect_success({"render", "builtin:wall", "--size", "32x24", "--samples", "64", "-o", path(name), "--json",
                    path("out.json"), "--radius", radius});
    return read_json("out.json")["radius"].get<double>();
  };
  const double length = render("0.25%", "share.exr");
  EXPECT_DOUBLE_EQ(length, 0.0025 * info["diagonal"].get<double>());
  EXPECT_EQ(render(nlohmann::json(length).dump(), "length.exr"), length);
  EXPECT_TRUE(read_file("share.exr") == read_file("length.exr"));
}

TEST_F(Render, MeanOcclusionIsThatOfTheImage) {
  expect_success(wall({"-o", path("out.exr"), "--depth", "--json", path("out.json")}));
  const image::Image image = image::read_image(path("out.exr"));
  const auto stride = static_cast<std::size_t>(image.channel_count());
  const auto occlusion = static_cast<std::size_t>(image.channel("occlusion"));
  const auto depth = static_cast<std::size_t>(image.channel("depth.Z"));
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += stride) {
    if (std::isinf(image.pixels[i + depth])) {
      EXPECT_EQ(image.pixels[i + occlusion], 0);  // background
      continue;
    }
    sum += image.pixels[i + occlusion];
    ++count;
  }
  const nlohmann::json json = read_json("out.json");
  EXPECT_EQ(json["receivers"], count);
  EXPECT_NEAR(json["occlusion_mean"], sum / count, 1e-9);
}

TEST_F(Render, PixelsThatSeeNothingAreNoReceivers) {
  const std::string scene = write_file("roofed.ply", roofed_square_ply());
  expect_success({"render", scene, "-o", path("out.exr"), "--size", "32x24", "--radius", "1", "--samples", "64",
                  "--eye", "0.3,2,3", "--target", "0,0,0", "--depth", "--reference", "--json", path("out.json")});
  const nlohmann::json json = read_json("out.json");
  const image::Image image = image::read_image(path("out.exr"));
  const auto stride = static_cast<std::size_t>(image.channel_count());
  int seen_count = 0;
  for (auto i = static_cast<std::size_t>(image.channel("depth.Z")); i < image.pixels.size(); i += stride) {
    seen_count += std::isinf(image.pixels[i]) ? 0 : 1;
  }
  EXPECT_GT(seen_count, 32 * 24 / 8);
  EXPECT_LT(seen_count, 32 * 24 * 7 / 8);
  EXPECT_EQ(json["receivers"], seen_count);
  EXPECT_EQ(json["rays"], seen_count * 64);
  EXPECT_EQ(json["invalid_receivers"], 0);
  EXPECT_EQ(json["reference"]["mismatched_rays"], 0);
}

TEST_F(Render, AgreesWithEmbreeRayByRay) {
  for (const char* sided : {"one", "two"}) {
    for (const char* falloff : {"constant", "exponential"}) {
      expect_success(wall(
          {"-o", path("out.exr"), "--sided", sided, "--falloff", falloff, "--reference", "--json", path("out.json")}));
      const nlohmann::json reference = read_json("out.json")["reference"];
      EXPECT_LE(reference["ray_mismatch_rate"], 1e-5);
      EXPECT_LE(reference["mae"], 1e-5);
    }
  }
}

TEST_F(Render, TakesAnyNumberOfSamplesOfEitherWeighting) {
  // Without end on one side, a wall darkens more where what stands low counts for more.
  double mean = 0;
  for (const char* weighting : {"cosine", "uniform"}) {
    for (const char* samples : {"1", "100"}) {
      expect_success({"render", "builtin:wall", "--size", "32x24", "--radius", "5", "--weighting", weighting,
                      "--samples", samples, "-o", path("out.exr"), "--reference", "--json", path("out.json")});
      const nlohmann::json json = read_json("out.json");
      EXPECT_EQ(json["weighting"], weighting);
      EXPECT_EQ(std::to_string(json["samples"].get<int>()), samples);
      EXPECT_EQ(json["rays"].get<int>(), json["receivers"].get<int>() * json["samples"].get<int>());
      EXPECT_LE(json["reference"]["mismatched_rays"], 1);
    }
    EXPECT_GT(read_json("out.json")["occlusion_mean"], mean);
    mean = read_json("out.json")["occlusion_mean"];
  }
}

TEST_F(Render, CountsFromAMinDistanceOn) {
  expect_success(wall({"-o", path("out.exr"), "--json", path("out.json")}));
  const nlohmann::json all = read_json("out.json");
  EXPECT_EQ(all["min_distance"], 0);
  expect_success(wall({"-o", path("out.exr"), "--min-distance", "0.125", "--reference", "--json", path("out.json")}));
  const nlohmann::json part = read_json("out.json");
  EXPECT_EQ(part["min_distance"], 0.125);
  EXPECT_LE(part["reference"]["ray_mismatch_rate"], 1e-5);
  EXPECT_GT(part["occlusion_mean"], 0);
  EXPECT_LT(part["occlusion_mean"], all["occlusion_mean"]);
}

TEST_F(Render, EitherMethodMayBeTheReference) {
  expect_success(wall({"-o", path("bvh.exr"), "--method", "bvh"}));
  expect_success(wall({"-o", path("embree.exr"), "--method", "embree", "--reference", "--json", path("out.json")}));
  EXPECT_EQ(read_json("out.json")["method"], "embree");
  EXPECT_EQ(read_json("out.json")["reference"]["method"], "bvh");
  EXPECT_EQ(image::read_image(path("bvh.exr")).pixels, image::read_image(path("embree.exr")).pixels);
}

TEST_F(Render, OptionsChangeThePicture) {
  expect_success(wall({"-o", path("plain.exr")}));
  const std::string plain = read_file("plain.exr");
  for (const Arguments& more : {Arguments{"--seed", "1"},
                                {"--falloff", "linear"},
                                {"--samples=64", "--fov", "40"},
                                {"--eye", "-.5,2,3"},
                                {"--target", "0,0.25,0"},
                                {"--up", "0.3,1,0"}}) {
    Arguments arguments = {"render", "builtin:wall", "--size", "32x24", "--radius", "0.5", "-o", path("other.exr")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    if (more.front() != "--samples=64") arguments.insert(arguments.end(), {"--samples", "64"});
    expect_success(arguments);
    EXPECT_TRUE(read_file("other.exr") != plain) << more.front();
  }
}

TEST_F(Render, ThreadsDoNotChangeABit) {
  const Arguments layers = {"--bent-normals", "--depth", "--normal-channels", "--preview"};
  Arguments one = wall({"-o", path("one.exr"), "--threads", "1"});
  Arguments two = wall({"-o", path("two.exr"), "--threads", "2"});
  one.insert(one.end(), layers.begin(), layers.end());
  two.insert(two.end(), layers.begin(), layers.end());
  one.push_back(path("one.png"));
  two.push_back(path("two.png"));
  expect_success(one);
  expect_success(two);
  EXPECT_TRUE(read_file("one.exr") == read_file("two.exr"));
  EXPECT_TRUE(read_file("one.png") == read_file("two.png"));
}

TEST_F(Render, LayersHoldUnitVectorsAndDepth) {
  expect_success(wall({"-o", path("out.exr"), "--bent-normals", "--depth", "--normal-channels"}));
  const image::Image image = image::read_image(path("out.exr"));
  EXPECT_EQ(std::set<std::string>(image.channels.begin(), image.channels.end()),
            (std::set<std::string>{"occlusion", "bent.X", "bent.Y", "bent.Z", "depth.Z", "normal.X", "normal.Y",
                                   "normal.Z"}));
  const auto stride = static_cast<std::size_t>(image.channel_count());
  const auto value = [&](std::size_t pixel, const std::string& channel) {
    return image.pixels[pixel * stride + static_cast<std::size_t>(image.channel(channel))];
  };
  for (std::size_t pixel = 0; pixel < image.pixels.size() / stride; ++pixel) {
    const double expected_length = std::isinf(value(pixel, "depth.Z")) ? 0 : 1;
    for (const std::string layer : {"bent", "normal"}) {
      const double length =
          std::hypot(value(pixel, layer + ".X"), value(pixel, layer + ".Y"), value(pixel, layer + ".Z"));
      EXPECT_NEAR(length, expected_length, 1e-5) << layer << " of pixel " << pixel;
    }
  }
}

TEST_F(Render, NormalsAreThoseAskedFor) {
  const auto sphere = [&](const Arguments& more) {
    Arguments arguments = {"render", "builtin:sphere", "-o", path("out.exr"),     "--size", "32x24",         "--radius",
                           "0.5",    "--samples",      "64", "--normal-channels", "--json", path("out.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_success(arguments);
    return read_file("out.exr");
  };
  const std::string plain = sphere({});
  EXPECT_EQ(read_json("out.json")["normals"], "facet");
  EXPECT_TRUE(sphere({"--normals", "facet"}) == plain);
  EXPECT_TRUE(sphere({"--normals", "smooth", "--reference"}) != plain);
  EXPECT_EQ(read_json("out.json")["normals"], "smooth");
  EXPECT_EQ(read_json("out.json")["reference"]["mismatched_rays"], 0);
  expect_rejected(wall({"-o", path("no.exr"), "--normals", "file"}), {"--normals file", "wall"});
}

TEST_F(Render, PngAndPreviewAreTheSamePicture) {
  expect_success(wall({"-o", path("out.png")}));
  expect_success(wall({"-o", path("out.exr"), "--preview", path("preview.png")}));
  EXPECT_EQ(files(), (std::vector<std::string>{"out.exr", "out.png", "preview.png"}));
  EXPECT_EQ(image::read_image(path("out.png")).pixels, image::read_image(path("preview.png")).pixels);
}

TEST_F(Render, JsonOnStdoutStandsAlone) {
  const ProgramResult result = expect_success(wall({"-o", path("out.exr"), "--json", "-"}));
  EXPECT_EQ(nlohmann::json::parse(result.out)["samples"], 64);
}

TEST_F(Render, QuietSaysNothing) { EXPECT_EQ(expect_success(wall({"-o", path("out.exr"), "--quiet"})).out, ""); }

TEST_F(Render, DroppedTrianglesAreReported) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::string scene =
      write_file("scene.ply", ply_bytes({{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {2, 0, 3}, {nan, 0, 0}},
                                        {{0, 2, 1}, {0, 0, 1}, {1, 1, 1}, {0, 1, 4}}));
  const ProgramResult result = run_program({"render", scene, "-o", path("out.exr"), "--size", "8x6", "--radius", "1",
                                            "--quiet", "--json", path("out.json")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.err.find("dropped 2 zero-area triangles"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("dropped 1 non-finite triangle\n"), std::string::npos) << result.err;
  EXPECT_EQ(read_json("out.json")["triangles"], 1);
  EXPECT_EQ(read_json("out.json")["dropped"], (nlohmann::json{{"zero_area", 2}, {"non_finite", 1}}));
}

TEST_F(Render, ACameraThatSeesNothingIsTold) {
  const ProgramResult result =
      run_program(wall({"-o", path("out.exr"), "--eye", "0,1e4,0", "--target", "1,2e4,0", "--json", path("out.json")}));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.err.find("sees no triangle"), std::string::npos) << result.err;
  EXPECT_EQ(read_json("out.json")["receivers"], 0);
  EXPECT_TRUE(read_json("out.json")["occlusion_mean"].is_null());
}

}  // namespace
}  // namespace lkao::test
