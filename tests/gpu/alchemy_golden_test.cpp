// Wavy ground as it was when its picture in golden/ was made: neither the definition in double nor the pass may drift
// from it, not even both together. After a change that is meant to change obscurance, make the picture anew, look at
// it, and commit it:
//
//   LKAO_REMAKE_GOLDEN=1 build/release/bin/lkao_test_gpu_alchemy --gtest_filter=AlchemyGolden.IsItsDefinition
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "gpu/alchemy_definition.h"
#include "gpu/golden_picture.h"
#include "gpu/on_software.h"

namespace lkao::gl::tests::alchemy_golden_test {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 72;
const GoldenPicture kGolden{"alchemy", kWidth, kHeight};
// With the paper's intensity, bias and epsilon.
constexpr AlchemyOptions kOptions{.radius = 0.35f};

class AlchemyGolden : public OnSoftware {
 protected:
  static PixelView ground() {
    return view_of_ground([](double x, double z) { return -0.9 + 0.1 * std::sin(7 * x + z) * std::cos(5 * z); }, kWidth,
                          kHeight);
  }
  static std::vector<float> draw(const PixelView& view, const AlchemyOptions& options) {
    AlchemyPass pass;
    return view.draw([&](const OcclusionTarget& to) { pass.draw(view.g_buffer(), view.camera(), options, to); });
  }
};

TEST_F(AlchemyGolden, IsItsDefinition) {
  const PixelView view = ground();
  const std::vector<double> expected = AlchemyDefinition(view).occlusion(kOptions);
  const std::vector<float> occlusion(expected.begin(), expected.end());
  kGolden.remake_if_wanted(occlusion);
  expect_golden(kGolden, occlusion, 0.51, 0.001, 1);
}

TEST_F(AlchemyGolden, IsDrawn) {
  const PixelView view = ground();
  AlchemyOptions many = kOptions;
  many.samples_per_band = 8192;
  many.max_band_count = 1;
  expect_golden(kGolden, draw(view, many), 2, 0.02, 12);
  // As many samples as by default.
  expect_golden(kGolden, draw(view, kOptions), 40, 0.15, 255);
}

}  // namespace
}  // namespace lkao::gl::tests::alchemy_golden_test
