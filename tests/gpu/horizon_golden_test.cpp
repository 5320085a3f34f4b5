// Wavy ground with a shelf over it as it was when its pictures in golden/ were made: neither the definition in double
// nor the pass may drift from them, not even both together. After a change that is meant to change occlusion, make them
// anew, look at them, and commit them:
//
//   LKAO_REMAKE_GOLDEN=1 build/release/bin/lkao_test_gpu_horizon --gtest_filter=HorizonGolden.AreTheirDefinition
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

#include "gpu/horizon_scene.h"
#include "gpu/on_software.h"
#include "image/image.h"

namespace lkao::gl::tests {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 72;

HorizonOptions options_of(HorizonEstimator estimator) {
  return {.estimator = estimator, .radius = 1.2f, .slice_count = 4, .step_count = 24, .thickness = 0.3f};
}

std::string path_of(HorizonEstimator estimator) {
  const char* name = estimator == HorizonEstimator::bitmask ? "vbao" : "gtao";
  return LKAO_GOLDEN_DIR "/" + std::string(name) + ".png";
}

class HorizonGolden : public OnSoftware {
 protected:
  static PixelView ground() {
    const PixelView waves = view_of_ground(
        [](double x, double z) { return -0.9 + 0.2 * std::sin(7 * x + z) * std::cos(5 * z); }, kWidth, kHeight);
    Mesh shelf;
    lkao::tests::add_quad(shelf, {-0.6f, -0.55f, -2.2f}, {1, 0.1f, 0}, {0, 0, 0.8f});
    std::vector<SeenPixel> pixels = view_of_mesh(shelf, waves.camera(), kWidth, kHeight).pixels();
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      if (!pixels[i].is_there()) pixels[i] = waves.pixels()[i];
    }
    return {waves.camera(), kWidth, kHeight, pixels};
  }
  // Pictures begin at the top.
  static std::vector<float> upside_down(const std::vector<float>& pixels) {
    std::vector<float> rows;
    for (std::ptrdiff_t y = kHeight; y-- > 0;) {
      rows.insert(rows.end(), pixels.begin() + y * kWidth, pixels.begin() + (y + 1) * kWidth);
    }
    return rows;
  }

  // In steps of 8 bits: no more than a share of the pixels may be farther off than half a step, the picture's own
  // rounding; rounding may choose another pixel to look at now and then.
  static void expect_golden(HorizonEstimator estimator, const std::vector<float>& occlusion) {
    const image::Image image = image::read_image(path_of(estimator));
    ASSERT_EQ(image.pixels.size(), occlusion.size());
    const std::vector<float> seen = upside_down(occlusion);
    std::size_t off_count = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      off_count += !(255 * std::fabs(double{seen[i]} - double{image.pixels[i]}) <= 0.51);
    }
    EXPECT_LE(static_cast<double>(off_count), 0.01 * static_cast<double>(seen.size()));
  }
};

TEST_F(HorizonGolden, AreTheirDefinition) {
  const PixelView view = ground();
  for (const HorizonEstimator estimator : kEstimators) {
    const HorizonDefinition definition(view, options_of(estimator));
    std::vector<float> occlusion;
    for (std::size_t i = 0; i < view.pixels().size(); ++i) {
      occlusion.push_back(view.pixels()[i].is_there() ? static_cast<float>(definition.of(i)) : 0.0f);
    }
    if (std::getenv("LKAO_REMAKE_GOLDEN") != nullptr) {
      image::write_image(path_of(estimator), {kWidth, kHeight, {"occlusion"}, upside_down(occlusion)});
    }
    expect_golden(estimator, occlusion);
  }
}

TEST_F(HorizonGolden, AreDrawn) {
  const PixelView view = ground();
  HorizonPass pass;
  for (const HorizonEstimator estimator : kEstimators) {
    expect_golden(estimator, draw_horizons(view, pass, options_of(estimator)));
  }
}

}  // namespace
}  // namespace lkao::gl::tests
