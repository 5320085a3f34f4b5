// A furnished room as it was when its picture in golden/ was made: neither the definition in double nor the
// pass may drift from it, not even both together. After a change that is meant to change occlusion, make the picture
// anew, look at it, and commit it:
//
//   LKAO_REMAKE_GOLDEN=1 build/release/bin/lkao_test_gpu_vao --gtest_filter=VaoGolden.IsItsDefinition
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "gpu/on_software.h"
#include "gpu/pass_scene.h"
#include "gpu/vao_definition.h"
#include "image/image.h"

namespace lkao::gl::tests {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 72;
constexpr const char* kPath = LKAO_GOLDEN_DIR "/vao.png";
constexpr float kRadius = 1.5f;

class VaoGolden : public OnSoftware {
 protected:
  static PixelView room() { return view_of_mesh(furnished_room(), room_camera(kWidth, kHeight), kWidth, kHeight); }
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

TEST_F(VaoGolden, IsItsDefinition) {
  const PixelView view = room();
  const VaoDefinition definition(view);
  std::vector<float> occlusion;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double value = definition.seen(x, y).is_there()
                               ? definition.occlusion(x, y, plain_set(kRadius, 32), VaoDefinition::set_of(x, y, 32))
                               : 0.0;
      occlusion.push_back(static_cast<float>(value));
    }
  }
  if (std::getenv("LKAO_REMAKE_GOLDEN") != nullptr) {
    image::write_image(kPath, {kWidth, kHeight, {"occlusion"}, upside_down(occlusion)});
  }
  // Half a step is the picture's own rounding.
  expect_golden(occlusion, 0.51, 0.001, 6);
}

TEST_F(VaoGolden, IsDrawn) {
  const PixelView view = room();
  VaoPass pass;
  // Places on the edges of pixels may be in either.
  expect_golden(draw_vao(view, pass, plain_set(kRadius, 32)), 0.51, 0.005, 12);
  // As it is by default: half of the samples.
  expect_golden(draw_vao(view, pass, {.radius = kRadius}), 12.5, 0.2, 150);
}

}  // namespace
}  // namespace lkao::gl::tests
