// Wavy ground as it was when its picture in golden/ was made: neither the definition in double nor the pass may drift
// from it, not even both together. After a change that is meant to change obscurance, make the picture anew, look at
// it, and commit it:
//
//   LKAO_REMAKE_GOLDEN=1 build/release/bin/lkao_test_gpu_alchemy --gtest_filter=AlchemyGolden.IsItsDefinition
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

#include "gpu/alchemy_definition.h"
#include "gpu/on_software.h"
#include "image/image.h"

namespace lkao::gl::tests {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 72;
constexpr const char* kPath = LKAO_GOLDEN_DIR "/alchemy.png";
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
    RecordProperty("worst", std::to_string(worst));
    EXPECT_LE(static_cast<double>(off_count), share * static_cast<double>(seen.size()));
    EXPECT_LE(worst, largest);
  }
};

TEST_F(AlchemyGolden, IsItsDefinition) {
  const PixelView view = ground();
  const std::vector<double> expected = AlchemyDefinition(view).occlusion(kOptions);
  const std::vector<float> occlusion(expected.begin(), expected.end());
  if (std::getenv("LKAO_REMAKE_GOLDEN") != nullptr) {
    image::write_image(kPath, {kWidth, kHeight, {"occlusion"}, upside_down(occlusion)});
  }
  // Half a step is the picture's own rounding.
  expect_golden(occlusion, 0.51, 0.001, 1);
}

TEST_F(AlchemyGolden, IsDrawn) {
  const PixelView view = ground();
  AlchemyOptions many = kOptions;
  many.samples_per_band = 8192;
  many.max_band_count = 1;
  expect_golden(draw(view, many), 2, 0.02, 12);
  // As many samples as by default.
  expect_golden(draw(view, kOptions), 40, 0.15, 255);
}

}  // namespace
}  // namespace lkao::gl::tests
