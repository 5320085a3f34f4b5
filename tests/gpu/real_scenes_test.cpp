// The pass on scenes of 75 K to 350 K triangles: it gives what the CPU gives, and its culls save what the paper says.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "gpu/on_software.h"
#include "gpu/pass_scene.h"
#include "gpu/rounding.h"
#include "image/metrics.h"
#include "scene/load.h"

namespace lkao::gl::tests::real_scenes_test {
namespace {

struct Size {
  int width, height;
};

struct Scene {
  const char* name;
  const char* file;  // of the shared scenes, or builtin:NAME
  float radius;
  glm::vec3 eye, target;
  float near, far;
};

// The name alone: the tests' names must not hold addresses.
void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }

class RealScenes : public OnSoftware, public testing::WithParamInterface<Scene> {
 protected:
  void SetUp() override {
    std::string path = GetParam().file;
    if (!path.starts_with("builtin:")) {
      path = (std::filesystem::path(LKAO_SHARED_DIR) / "scenes" / path).string();
      if (!std::filesystem::exists(path)) {
        GTEST_SKIP() << "NOT TESTED: the shared scene " << GetParam().file << " is missing (looked in "
                     << LKAO_SHARED_DIR << "; set the environment variable or the CMake variable LKAO_SHARED_DIR)";
      }
    }
    OnSoftware::SetUp();
    if (IsSkipped()) return;
    scene::Mesh mesh = scene::load(path);
    mesh_ = {std::move(mesh.positions), std::move(mesh.triangles)};
    const Scene& scene = GetParam();
    camera_ = {glm::lookAt(scene.eye, scene.target, glm::vec3(0, 1, 0)),
               glm::perspective(1.12f, 4.0f / 3, scene.near, scene.far), ClipDepth::minus_one_to_one};
  }
  void TearDown() override { g_buffer_.reset(); }

  void see_at(Size size) { g_buffer_ = std::make_unique<GBufferPass>(mesh_, camera_, size.width, size.height); }

  Mesh mesh_;
  Camera camera_;
  std::unique_ptr<GBufferPass> g_buffer_;
};

// The occlusion of masks of 128 rays.
std::vector<float> occlusion_of(const std::vector<std::uint64_t>& masks) {
  std::vector<float> occlusion;
  for (std::size_t i = 0; i < masks.size(); i += 2) {
    occlusion.push_back(static_cast<float>(count_bits({masks[i], masks[i + 1]})) / 128);
  }
  return occlusion;
}

TEST_P(RealScenes, AreWhatTheQueryAnswers) {
  const PlaneMaskTable exact(SamplePattern::standard(128), {.resolution = 64});
  see_at({64, 48});
  PassOnMesh pass = make_pass(mesh_, exact);
  const RayOptions options{.radius = GetParam().radius, .seed = 3};
  pass.draw(g_buffer_->by_positions(), camera_, options);
  const std::vector<std::uint64_t> masks = pass.read_masks();
  const std::vector<Receiver> receivers = g_buffer_->receivers();
  const std::vector<std::uint64_t> expected = cpu_masks(mesh_, receivers, exact.pattern(), options);
  ASSERT_GT(count_bits(expected), masks.size() * 3) << "too little occlusion to tell anything";
  const std::uint64_t difference_count = count_differences(masks, expected);
  ASSERT_LE(difference_count, masks.size() * 64 / 10000);
  EXPECT_EQ(count_unexplained(mesh_.view(), masks, expected, receivers, exact.pattern(), options), 0u)
      << "of " << difference_count;
  RecordProperty("differing_rays", std::to_string(difference_count) + " of " + std::to_string(masks.size() * 64));

  // The paper's own masks (Sec. 6): most pixels are correct at 8 bits, and the mean error is about that of
  // quantisation.
  pass.set_table(PlaneMaskTable(exact.pattern(), {.resolution = 128, .masks = PlaneMasks::nearest}));
  pass.draw(g_buffer_->by_positions(), camera_, options);
  const image::Metrics metrics = image::compare(occlusion_of(pass.read_masks()), occlusion_of(expected));
  EXPECT_GT(metrics.equal_8bit_share, 0.5);
  EXPECT_LT(metrics.mae, 1.0 / 255);
  RecordProperty("nearest_same_at_8_bits", std::to_string(metrics.equal_8bit_share));
  RecordProperty("nearest_mean_error", std::to_string(metrics.mae));
}

TEST_P(RealScenes, AreCulledAsInThePaper) {
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32, .masks = PlaneMasks::nearest});
  see_at({24, 18});
  PassOnMesh pass = make_pass(mesh_, table, {.count_fragments = true});
  const RayOptions options{.radius = GetParam().radius, .sidedness = Sidedness::one_sided};
  RasterOptions raster{.culls = {false, false, false, false, false}};
  pass.draw(g_buffer_->by_positions(), camera_, options, raster);
  const FragmentCounts all = pass.read_fragment_counts();
  EXPECT_EQ(all.survivors, all.drawn);
  std::uint64_t before = all.survivors;
  std::string shares;
  // Table 2: one more each time, and each saves some.
  for (bool Culls::*cull :
       {&Culls::far_depth, &Culls::bounding_sphere, &Culls::facing, &Culls::plane_distance, &Culls::horizon}) {
    raster.culls.*cull = true;
    pass.draw(g_buffer_->by_positions(), camera_, options, raster);
    const FragmentCounts counts = pass.read_fragment_counts();
    EXPECT_EQ(counts.drawn, all.drawn);
    EXPECT_LT(counts.survivors, before);
    before = counts.survivors;
    shares += std::to_string(static_cast<double>(before) / static_cast<double>(all.drawn)) + " ";
  }
  EXPECT_LT(3 * before, all.drawn) << "all five together cut the masks by several times";
  RecordProperty("drawn_fragments", std::to_string(all.drawn));
  RecordProperty("surviving_shares", shares);
}

INSTANTIATE_TEST_SUITE_P(
    All, RealScenes,
    testing::Values(Scene{"atrium", "builtin:atrium", 0.5f, {-13.4f, 2.5f, 1.5f}, {2.0f, 3.9f, -0.9f}, 0.05f, 100.0f},
                    Scene{"sibenik", "sibenik.ply", 0.75f, {-16, -11, 0}, {4, -6, 0.5f}, 0.05f, 100.0f},
                    Scene{"sponza", "sponza_crytek.ply", 65, {-1100, 300, -30}, {500, 250, 0}, 5.0f, 10000.0f}),
    [](const testing::TestParamInfo<Scene>& scene) { return std::string(scene.param.name); });

}  // namespace
}  // namespace lkao::gl::tests::real_scenes_test
