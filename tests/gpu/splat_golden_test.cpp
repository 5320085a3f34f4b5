// Wavy ground under some balls as it was when its picture in golden/ was made: neither the definition in double nor the
// pass may drift from it, not even both together. After a change that is meant to change occlusion, make the picture
// anew, look at it, and commit it:
//
//   LKAO_REMAKE_GOLDEN=1 build/release/bin/lkao_test_gpu_splat --gtest_filter=SplatGolden.IsItsDefinition
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

#include "gpu/on_software.h"
#include "gpu/splat_scene.h"
#include "image/image.h"

namespace lkao::gl::tests {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 72;
constexpr const char* kPath = LKAO_GOLDEN_DIR "/splats.png";
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
  // Pictures begin at the top.
  static std::vector<float> upside_down(const std::vector<float>& pixels) {
    std::vector<float> rows;
    for (std::ptrdiff_t y = kHeight; y-- > 0;) {
      rows.insert(rows.end(), pixels.begin() + y * kWidth, pixels.begin() + (y + 1) * kWidth);
    }
    return rows;
  }

  // In steps of 8 bits: no pixel may be farther off than `largest`, and only a share of them farther than `small`.
  static void expect_golden(const std::vector<float>& occlusion, double small, double share, double largest) {
    const image::Image image = image::read_image(kPath);
    ASSERT_EQ(image.pixels.size(), occlusion.size());
    const std::vector<float> seen = upside_down(occlusion);
    std::size_t off_count = 0;
    double worst = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const double off = 255 * std::fabs(double{seen[i]} - double{image.pixels[i]});
      off_count += !(off <= small);
      worst = std::max(worst, off);
    }
    EXPECT_LE(static_cast<double>(off_count), share * static_cast<double>(seen.size()));
    EXPECT_LE(worst, largest);
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
  if (std::getenv("LKAO_REMAKE_GOLDEN") != nullptr) {
    image::write_image(kPath, {kWidth, kHeight, {"occlusion"}, upside_down(occlusion)});
  }
  // Half a step is the picture's own rounding.
  expect_golden(occlusion, 0.51, 0.001, 6);
}

TEST_F(SplatGolden, IsDrawn) {
  const PixelView view = ground();
  SplatPass pass;
  pass.set_spheres(balls());
  expect_golden(draw_splats(view, pass, kOptions), 0.51, 0.005, 6);
  // As many samples as by default.
  SplatOptions few = kOptions;
  few.samples_per_pixel = SplatOptions().samples_per_pixel;
  few.max_sample_count = SplatOptions().max_sample_count;
  expect_golden(draw_splats(view, pass, few), 8.5, 0.05, 60);
}

}  // namespace
}  // namespace lkao::gl::tests
