// The furnished room as it was when its pictures in golden/ were made: neither query nor pass may drift from it, not
// even both together.
//
// The receivers are found here, by casting rays, and not by OpenGL: they are the same for every driver. After a change
// that is meant to change occlusion, make the pictures anew, look at them, and commit them:
//
//   LKAO_REMAKE_GOLDEN=1 build/release/bin/lkao_test_gpu --gtest_filter=GoldenImages.AreWhatTheQueryAnswers
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "gpu/camera_rays.h"
#include "gpu/golden_picture.h"
#include "gpu/on_software.h"
#include "gpu/pass_scene.h"
#include "support/sanitized.h"

namespace lkao::gl::tests::golden_images_test {
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

// What the pictures show, found once.
const std::vector<Receiver>& seen_receivers() {
  static const std::vector<Receiver> receivers =
      cast_camera_rays(furnished_room(), room_camera(kWidth, kHeight), kWidth, kHeight);
  return receivers;
}

GoldenPicture picture_of(const Golden& golden) { return {golden.name, kWidth, kHeight}; }

TEST(GoldenImages, AreWhatTheQueryAnswers) {
  const Mesh mesh = furnished_room();
  const std::vector<Receiver>& receivers = seen_receivers();
  for (const Golden& golden : all_golden()) {
    std::vector<float> occlusion(receivers.size());
    AmbientOcclusion(OccluderBvh(mesh.view()), golden.pattern, golden.options)
        .query(receivers, {.occlusion = occlusion});
    for (float& value : occlusion) value = std::isnan(value) ? 0 : value;
    picture_of(golden).remake_if_wanted(occlusion);
    // What is farther off is for other processors' sines: of the camera, of the ball.
    expect_golden(picture_of(golden), occlusion, 0.51, 0.001, 6);
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
  const std::vector<Receiver>& receivers = seen_receivers();
  std::vector<Golden> all = all_golden();
  if (lkao::tests::kIsSanitized) all.pop_back();
  for (const Golden& golden : all) {
    for (const auto& [geometry, accumulator] : {std::pair{GeometryBackEnd::vertex_pulling, Accumulator::logic_op},
                                                {GeometryBackEnd::geometry_shader, Accumulator::ssbo}}) {
      const PlaneMaskTable exact(golden.pattern, {.resolution = 48});
      PassOnMesh pass = make_pass(mesh, exact, {.geometry = geometry, .accumulator = accumulator});
      // A ray of 128 is two steps.
      expect_golden(picture_of(golden), draw(pass, receivers, camera, golden.options), 0.51, 0.002, 6);
    }
    const PlaneMaskTable nearest(golden.pattern, {.resolution = 128, .masks = PlaneMasks::nearest});
    PassOnMesh pass = make_pass(mesh, nearest);
    expect_golden(picture_of(golden), draw(pass, receivers, camera, golden.options), 4.51, 0.06, 30);
  }
}

}  // namespace
}  // namespace lkao::gl::tests::golden_images_test
