// lkao render --method raster: the picture of the other methods, drawn by OpenGL on the CPU.
#include <epoxy/gl.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <stdexcept>

#include "cli/gl_program.h"
#include "cli/small_mesh.h"
#include "image/image.h"
#include "image/metrics.h"
#include "lkao/gl.h"
#include "support/sanitized.h"

namespace lkao::test {
namespace {

class RasterRender : public GlProgramTest {
 protected:
  // A rendering of the small scene; `more` may hold options of any method.
  Arguments render(const std::string& method, const std::string& size, const Arguments& more = {}) const {
    return render_small_scene(method, size, method, more);
  }

  std::vector<float> channel(const std::string& name, const std::string& channel_name) const {
    const image::Image image = image::read_image(path(name));
    std::vector<float> values;
    const auto stride = static_cast<std::size_t>(image.channel_count());
    for (auto i = static_cast<std::size_t>(image.channel(channel_name)); i < image.pixels.size(); i += stride) {
      values.push_back(image.pixels[i]);
    }
    return values;
  }
};

TEST_F(RasterRender, DrawsWhatSurroundsTheSceneToo) {
  const Arguments more = {
      "--ground", "--blockers",
      write_file("roof.ply", ply_bytes({{-9, 1.2f, -9}, {9, 1.2f, -9}, {0, 1.2f, 9}}, {{0, 2, 1}}))};
  expect_success(render("raster", "33x17"));
  const std::vector<float> alone = channel("raster.exr", "occlusion");
  expect_success(render("bvh", "33x17", more));
  expect_success(render("raster", "33x17", more));
  EXPECT_NE(channel("raster.exr", "occlusion"), alone);
  EXPECT_LT(image::compare(channel("raster.exr", "occlusion"), channel("bvh.exr", "occlusion")).mae, 1e-4);
}

TEST_F(RasterRender, IsTheSameAsAProcessOfItsOwn) {
  EXPECT_EQ(expect_same_as_process(render("raster", "33x17", {"--quiet"}), "raster.exr"), 0);
}

TEST_F(RasterRender, IsThePictureOfTheTraversal) {
  const Arguments layers = {"--bent-normals", "--depth", "--normal-channels", "--seed", "4"};
  for (const char* size : {"1x1", "33x17", "17x33", "64x48"}) {
    SCOPED_TRACE(size);
    expect_success(render("bvh", size, layers));
    expect_success(render("raster", size, layers));
    for (const char* name : {"depth.Z", "normal.X", "normal.Y", "normal.Z"}) {
      EXPECT_EQ(channel("raster.exr", name), channel("bvh.exr", name)) << name;
    }
    for (const char* name : {"occlusion", "bent.X", "bent.Y", "bent.Z"}) {
      const image::Metrics metrics = image::compare(channel("raster.exr", name), channel("bvh.exr", name));
      EXPECT_LT(metrics.mae, 1e-4) << name;
      EXPECT_GT(metrics.equal_8bit_share, 0.99) << name;
    }
    const nlohmann::json raster = read_json("raster.json"), bvh = read_json("bvh.json");
    for (const char* key : {"receivers", "rays", "invalid_receivers"}) EXPECT_EQ(raster[key], bvh[key]) << key;
    EXPECT_NEAR(raster["occlusion_mean"].get<double>(), bvh["occlusion_mean"].get<double>(), 1e-4);
    EXPECT_GT(raster["occlusion_mean"], 0.02);
  }
  EXPECT_LT(read_json("raster.json")["receivers"], 64 * 48);
  EXPECT_EQ(read_json("raster.json")["invalid_receivers"], 0);
}

TEST_F(RasterRender, AgreesWithEmbreeRayByRay) {
  const char* const many = tests::unless_sanitized<const char*>("1024", "256");
  for (const Arguments& more : {Arguments{"--reference", "--sided", "one"},
                                {"--reference", "--samples", "64"},
                                {"--reference", "--samples", "192", "--falloff", "exponential"},
                                {"--reference", "--samples", many, "--seed", "9"}}) {
    SCOPED_TRACE(testing::PrintToString(more));
    expect_success(render("raster", "33x17", more));
    const nlohmann::json json = read_json("raster.json");
    EXPECT_EQ(json["method"], "raster");
    EXPECT_EQ(json["reference"]["method"], "embree");
    EXPECT_LE(json["reference"]["ray_mismatch_rate"], 1e-4);
    EXPECT_LE(json["reference"]["mae"], 1e-4);
    EXPECT_GT(json["occlusion_mean"], 0.02);
  }
}

TEST_F(RasterRender, ShadesSmoothlyAsTheTraversalDoes) {
  expect_success(render("raster", "33x17", {"--normals", "smooth", "--reference"}));
  EXPECT_EQ(read_json("raster.json")["normals"], "smooth");
  EXPECT_LE(read_json("raster.json")["reference"]["ray_mismatch_rate"], 1e-4);
}

TEST_F(RasterRender, TakesAnInfiniteRadius) {
  const auto render = [&](const Arguments& more) {
    Arguments arguments = {"render",   scene_,           "--method",   "raster",   "--gl",  "software",
                           "--size",   "33x17",          "--radius",   "inf",      "--eye", "1.2,1.8,2.4",
                           "--target", "0.05,0.45,-0.1", "--up",       "0.15,1,0", "-o",    path("a.exr"),
                           "--json",   path("a.json"),   "--reference"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  for (const Arguments& more : {Arguments{}, {"--sided", "one"}, {"--masks", "nearest"}, {"--lod", "k=5"}}) {
    SCOPED_TRACE(testing::PrintToString(more));
    expect_success(render(more));
    const nlohmann::json json = read_json("a.json");
    EXPECT_TRUE(json.at("radius").is_null());
    const bool is_exact = more.empty() || more[0] == "--sided";
    EXPECT_LE(json["reference"]["ray_mismatch_rate"], is_exact ? 1e-4 : 0.05);
    EXPECT_GT(json["occlusion_mean"], 0.02);
  }
}

TEST_F(RasterRender, InfiniteFalloffsAreRefused) {
  Arguments arguments = {"render", scene_, "--method", "raster", "--radius", "inf", "--falloff", "smooth"};
  arguments.insert(arguments.end(), {"-o", path("a.exr")});
  expect_rejected(arguments, {"--radius inf", "--falloff smooth", "--method raster"});
}

TEST_F(RasterRender, NearestMasksAreMostlyTheSame) {
  expect_success(render("raster", "64x48", {"--masks", "nearest", "--reference"}));
  const nlohmann::json json = read_json("raster.json");
  EXPECT_EQ(json["masks"], "nearest");
  EXPECT_GT(json["reference"]["mismatched_rays"], 0);
  EXPECT_LT(json["reference"]["ray_mismatch_rate"], 0.01);
  EXPECT_LT(json["reference"]["mae"], 1.0 / 255);
}

TEST_F(RasterRender, JsonSaysWhatDrew) {
  const ProgramResult result = expect_success(render("raster", "33x17"));
  const nlohmann::json json = read_json("raster.json"), gl = json["gl"];
  EXPECT_EQ(json["masks"], "exact");
  EXPECT_FALSE(json.contains("kernel"));
  EXPECT_FALSE(json.contains("reference"));
  EXPECT_EQ(gl["renderer"], software_->renderer());
  EXPECT_EQ(gl["version"], software_->version());
  EXPECT_EQ(gl["software"], true);
  EXPECT_TRUE(gl["geometry"] == "vertex_pulling" || gl["geometry"] == "geometry_shader") << gl;
  EXPECT_TRUE(gl["accumulator"] == "logic_op" || gl["accumulator"] == "ssbo") << gl;
  EXPECT_GT(gl["draw_milliseconds"], 0);
  EXPECT_GE(gl["draw_count"], 1);
  EXPECT_NEAR(json["seconds"].get<double>() * 1000, gl["draw_milliseconds"], 1e-9);
  EXPECT_NEAR(json["mrays_per_second"].get<double>(), json["rays"].get<double>() / json["seconds"].get<double>() / 1e6,
              1e-6);
  EXPECT_EQ(json["rays"], json["receivers"].get<int>() * 128);
  for (const std::string& word : {software_->renderer(), std::string("raster"), std::string("exact masks")}) {
    EXPECT_NE(result.out.find(word), std::string::npos) << word << "\n" << result.out;
  }
}

TEST_F(RasterRender, ACameraThatSeesNothingIsTold) {
  Arguments arguments = {"render", scene_, "--method", "raster", "--gl", "software", "--size", "9x7", "--radius", "1"};
  arguments.insert(arguments.end(), {"--eye", "0,1e4,0", "--target", "1,2e4,0", "--quiet", "-o", path("out.exr"),
                                     "--json", path("out.json")});
  const ProgramResult result = run_program(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("sees no triangle"), std::string::npos) << result.err;
  EXPECT_EQ(read_json("out.json")["rays"], 0);
  EXPECT_EQ(read_json("out.json")["invalid_receivers"], 0);
}

TEST_F(RasterRender, OptionsOfOtherMethodsAreRefused) {
  expect_rejected(render("raster", "9x7", {"--kernel", "table"}), {"--kernel", "--method bvh", "--masks"});
  expect_rejected(render("bvh", "9x7", {"--masks", "exact"}), {"--masks", "--method raster", "--method bvh"});
  expect_rejected(render("embree", "9x7", {"--gl", "auto"}), {"--gl", "--method raster", "--method embree"});
  expect_rejected(render("raster", "9x7", {"--masks", "some"}), {"--masks", "some", "exact or nearest"});
  expect_rejected({"render", scene_, "--radius", "1", "-o", path("out.exr"), "--method", "raster", "--gl", "best"},
                  {"--gl", "best", "software or hardware or auto"});
}

TEST_F(RasterRender, ATooLargeImageIsRefused) {
  software_->make_current();
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  software_->release();
  if (largest >= 32768) GTEST_SKIP() << "needs an OpenGL with textures of less than 32768 texels a side";
  expect_rejected(render("raster", "32768x1"), {"32768x1", std::to_string(largest)});
}

TEST_F(RasterRender, MissingHardwareIsNamed) {
  try {
    const gl::HeadlessContext hardware(gl::Device::hardware);
    GTEST_SKIP() << "needs a machine without " << hardware.renderer();
  } catch (const std::runtime_error&) {
  }
  expect_rejected({"render", scene_, "--radius", "1", "-o", path("out.exr"), "--json", path("out.json"), "--method",
                   "raster", "--gl", "hardware"},
                  {"OpenGL 4.5", "no hardware device"});
}

}  // namespace
}  // namespace lkao::test
