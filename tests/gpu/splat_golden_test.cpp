// Wavy ground under some balls as it was when its picture in golden/ was made: neither the definition in double nor the
// pass may drift from it, not even both together. After a change that is meant to change occlusion, make the picture
// anew, look at it, and commit it:
//
//   LKAO_REMAKE_GOLDEN=1 build/release/bin/lkao_test_gpu_splat --gtest_filter=SplatGolden.IsItsDefinition
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "gpu/golden_picture.h"
#include "gpu/on_software.h"
#include "gpu/splat_scene.h"

namespace lkao::gl::tests::splat_golden_test {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 72;
const GoldenPicture kGolden{"splats", kWidth, kHeight};
constexpr SplatOptions kOptions{
    .near_radius = 0.3f, .samples_per_pixel = 1e6f, .max_sample_count = 16384, .pixel_sphere_radius = 0.4f};

class SplatGolden : public OnSoftware {
 protected:
  static PixelView ground() {
    return view_of_ground([](double x, double z) { return -0.9 + 0.1 * std::sin(7 * x + z) * std::cos(5 * z); }, kWidth,
                          kHeight);
  }
  static std::vector<glm::vec4> balls() {
    return {{-0.5f, -0.6f, -2, 0.25f}, {0.6f, -0.5f, -2.4f, 0.35f}, {0.1f, -0.75f, -1.6f, 0.12f}, {0, 0, -5, 1}};
  }
};

TEST_F(SplatGolden, IsItsDefinition) {
  const PixelView view = ground();
  std::vector<float> occlusion;
  for (std::size_t i = 0; i < view.pixels().size(); ++i) {
    const SeenPixel& pixel = view.pixels()[i];
    const double sum =
        pixel.is_there() ? expected_near(view, i, {&view}, kOptions) + expected_far(pixel, balls(), kOptions) : 0.0;
    occlusion.push_back(static_cast<float>(std::fmin(sum, 1.0)));
  }
  kGolden.remake_if_wanted(occlusion);
  expect_golden(kGolden, occlusion, 0.51, 0.001, 6);
}

TEST_F(SplatGolden, IsDrawn) {
  const PixelView view = ground();
  SplatPass pass;
  pass.set_spheres(balls());
  expect_golden(kGolden, draw_splats(view, pass, kOptions), 0.51, 0.005, 6);
  // As many samples as by default.
  SplatOptions few = kOptions;
  few.samples_per_pixel = SplatOptions().samples_per_pixel;
  few.max_sample_count = SplatOptions().max_sample_count;
  expect_golden(kGolden, draw_splats(view, pass, few), 8.5, 0.05, 60);
}

}  // namespace
}  // namespace lkao::gl::tests::splat_golden_test
