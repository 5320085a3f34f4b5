// Wavy ground with a shelf over it as it was when its pictures in golden/ were made: neither the definition in double
// nor the pass may drift from them, not even both together. After a change that is meant to change occlusion, make them
// anew, look at them, and commit them:
//
//   LKAO_REMAKE_GOLDEN=1 build/release/bin/lkao_test_gpu_horizon --gtest_filter=HorizonGolden.AreTheirDefinition
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "gpu/golden_picture.h"
#include "gpu/horizon_scene.h"
#include "gpu/on_software.h"

namespace lkao::gl::tests::horizon_golden_test {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 72;

HorizonOptions options_of(HorizonEstimator estimator) {
  return {.estimator = estimator, .radius = 1.2f, .slice_count = 4, .step_count = 24, .thickness = 0.3f};
}

GoldenPicture golden_of(HorizonEstimator estimator) {
  return {estimator == HorizonEstimator::bitmask ? "vbao" : "gtao", kWidth, kHeight};
}

// Rounding may choose another pixel to look at now and then.
void expect_nearly_golden(HorizonEstimator estimator, const std::vector<float>& occlusion) {
  expect_golden(golden_of(estimator), occlusion, 0.51, 0.01, 255);
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
};

TEST_F(HorizonGolden, AreTheirDefinition) {
  const PixelView view = ground();
  for (const HorizonEstimator estimator : kEstimators) {
    const HorizonDefinition definition(view, options_of(estimator));
    std::vector<float> occlusion;
    for (std::size_t i = 0; i < view.pixels().size(); ++i) {
      occlusion.push_back(view.pixels()[i].is_there() ? static_cast<float>(definition.of(i)) : 0.0f);
    }
    golden_of(estimator).remake_if_wanted(occlusion);
    expect_nearly_golden(estimator, occlusion);
  }
}

TEST_F(HorizonGolden, AreDrawn) {
  const PixelView view = ground();
  HorizonPass pass;
  for (const HorizonEstimator estimator : kEstimators) {
    expect_nearly_golden(estimator, draw_horizons(view, pass, options_of(estimator)));
  }
}

}  // namespace
}  // namespace lkao::gl::tests::horizon_golden_test
