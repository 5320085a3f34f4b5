// The furnished room as it was when its pictures in golden/ were made: neither query nor pass may drift from it, not
// even both together.
//
// The receivers are found here, by casting rays, and not by OpenGL: they are the same for every driver. After a change
// that is meant to change occlusion, make the pictures anew, look at them, and commit them:
//
//   LKAO_REMAKE_GOLDEN=1 build/release/bin/lkao_test_gpu --gtest_filter=GoldenImages.AreWhatTheQueryAnswers
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

#include "gpu/camera_rays.h"
#include "gpu/on_software.h"
#include "gpu/pass_scene.h"
#include "image/image.h"

namespace lkao::gl::tests {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;

struct Golden {
  const char* name;
  RayOptions options;
  SamplePattern pattern;
};

std::vector<Golden> all_golden() {
  const SamplePattern& pattern = SamplePattern::standard(128);
  return {{"two_sided", {.radius = 0.8f}, pattern},
          {"one_sided_linear",
           {.radius = 2.5f, .sidedness = Sidedness::one_sided, .seed = 7},
           pattern.with_falloff(Falloff::linear())}};
}

std::string path_of(const Golden& golden) { return std::string(LKAO_GOLDEN_DIR "/") + golden.name + ".png"; }

// Pictures begin at the top.
std::vector<float> upside_down(const std::vector<float>& pixels) {
  std::vector<float> rows;
  for (std::ptrdiff_t y = kHeight; y-- > 0;) {
    const auto first = pixels.begin() + y * kWidth;
    rows.insert(rows.end(), first, first + kWidth);
  }
  return rows;
}

// Two tolerances, in steps of the 8 bits of a picture: no pixel may be farther off than `largest`, and only a share of
// them farther than `small`.
void expect_golden(const Golden& golden, const std::vector<float>& occlusion, double small, double share,
                   double largest) {
  const image::Image image = image::read_image(path_of(golden));
  ASSERT_EQ(image.width, kWidth);
  ASSERT_EQ(image.height, kHeight);
  ASSERT_EQ(image.channel_count(), 1);
  const std::vector<float> seen = upside_down(occlusion);
  std::size_t off_count = 0;
  double worst = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const double difference = 255 * std::fabs(static_cast<double>(seen[i]) - static_cast<double>(image.pixels[i]));
    off_count += !(difference <= small);
    worst = std::max(worst, difference);
  }
  const double off_share = static_cast<double>(off_count) / static_cast<double>(seen.size());
  EXPECT_LE(off_share, share) << golden.name;
  EXPECT_LE(worst, largest) << golden.name;
  ::testing::Test::RecordProperty(std::string(golden.name) + (small < 1 ? "_exact" : "_nearest"),
                                  std::to_string(off_share) + " off, at most " + std::to_string(worst));
}

TEST(GoldenImages, AreWhatTheQueryAnswers) {
  const Mesh mesh = furnished_room();
  const std::vector<Receiver> receivers = cast_camera_rays(mesh, room_camera(kWidth, kHeight), kWidth, kHeight);
  for (const Golden& golden : all_golden()) {
    std::vector<float> occlusion(receivers.size());
    AmbientOcclusion(OccluderBvh(mesh.view()), golden.pattern, golden.options)
        .query(receivers, {.occlusion = occlusion});
    for (float& value : occlusion) value = std::isnan(value) ? 0 : value;
    if (std::getenv("LKAO_REMAKE_GOLDEN") != nullptr) {
      image::write_image(path_of(golden), {kWidth, kHeight, {"occlusion"}, upside_down(occlusion)});
    }
    // Half a step is the picture's own rounding. The rest is for other processors' sines: of the camera, of the ball.
    expect_golden(golden, occlusion, 0.51, 0.001, 6);
  }
}

class GoldenImagesOnSoftware : public OnSoftware {
 protected:
  // What the pass resolves for receivers given as textures.
  static std::vector<float> draw(PassOnMesh& pass, const std::vector<Receiver>& receivers, const Camera& camera,
                                 const RayOptions& options) {
    std::vector<glm::vec4> positions, normals;
    for (const Receiver& receiver : receivers) {
      positions.emplace_back(receiver.position, 1);
      normals.emplace_back(receiver.normal, 0);
    }
    const Texture position_image = make_image(GL_RGBA32F, kWidth, kHeight, &positions[0].x);
    const Texture normal_image = make_image(GL_RGBA32F, kWidth, kHeight, &normals[0].x);
    const Texture target = make_image(GL_R32F, kWidth, kHeight);
    pass.draw({.width = kWidth, .height = kHeight, .positions = position_image.name(), .normals = normal_image.name()},
              camera, options);
    pass.resolve({.occlusion = {target.name()}});
    std::vector<float> occlusion;
    for (const glm::vec4& pixel : read_image(target.name(), kWidth, kHeight)) occlusion.push_back(pixel.x);
    return occlusion;
  }
};

TEST_F(GoldenImagesOnSoftware, AreDrawn) {
  const Mesh mesh = furnished_room();
  const Camera camera = room_camera(kWidth, kHeight);
  const std::vector<Receiver> receivers = cast_camera_rays(mesh, camera, kWidth, kHeight);
  for (const Golden& golden : all_golden()) {
    for (const auto& [geometry, accumulator] : {std::pair{GeometryBackEnd::vertex_pulling, Accumulator::logic_op},
                                                {GeometryBackEnd::geometry_shader, Accumulator::ssbo}}) {
      const PlaneMaskTable exact(golden.pattern, {.resolution = 48});
      PassOnMesh pass = make_pass(mesh, exact, {.geometry = geometry, .accumulator = accumulator});
      // A ray of 128 is two steps.
      expect_golden(golden, draw(pass, receivers, camera, golden.options), 0.51, 0.002, 6);
    }
    const PlaneMaskTable nearest(golden.pattern, {.resolution = 128, .masks = PlaneMasks::nearest});
    PassOnMesh pass = make_pass(mesh, nearest);
    expect_golden(golden, draw(pass, receivers, camera, golden.options), 4.51, 0.06, 30);
  }
}

}  // namespace
}  // namespace lkao::gl::tests
