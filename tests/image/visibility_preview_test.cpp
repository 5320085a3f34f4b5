#include <cmath>

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "image/image.h"
#include "temporary_folder.h"

namespace lkao::image::visibility_preview_test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
using Names = std::vector<std::string>;

TEST(VisibilityPreview, IsOneMinusOcclusionSrgbEncoded) {
  // Linear 1, 0, 0.5, 0.002 and 0.21404114 (which encodes to one half).
  const Image preview = visibility_preview({5, 1, {"occlusion"}, {0, 1, 0.5f, 0.998f, 1 - 0.21404114f}});
  ASSERT_EQ(preview.channels, (Names{"R", "G", "B"}));
  ASSERT_EQ(preview.pixels.size(), 15u);
  const float expected[] = {1.0f, 0.0f, 0.7353570f, 0.02584f, 0.5f};
  for (std::size_t pixel = 0; pixel < 5; ++pixel) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(preview.pixels[3 * pixel + c], expected[pixel], 1e-6) << pixel;
  }
}

TEST(VisibilityPreview, NoReceiverIsTheBackgroundAndNoGrey) {
  const Image preview = visibility_preview({2, 1, {"occlusion"}, {kNaN, 0.25f}});
  for (const float value : preview.pixels) EXPECT_TRUE(value >= 0 && value <= 1) << value;
  EXPECT_NE(preview.pixels[0], preview.pixels[2]);
  EXPECT_EQ(preview.pixels[3], preview.pixels[5]);
}

TEST(VisibilityPreview, FindsTheChannelByName) {
  const Image image{2, 1, {"depth.Z", "occlusion", "normal.X"}, {5, 1, 0.1f, 6, 0, 0.2f}};
  EXPECT_EQ(visibility_preview(image).pixels, (std::vector<float>{0, 0, 0, 1, 1, 1}));
  const Image unnamed{1, 1, {"Y"}, {0}};
  EXPECT_EQ(visibility_preview(unnamed).pixels, (std::vector<float>{1, 1, 1}));
}

TEST(VisibilityPreview, ThrowsWithoutOcclusion) {
  EXPECT_THROW(visibility_preview({1, 1, {"depth.Z", "normal.X"}, {1, 2}}), std::invalid_argument);
}

TEST(VisibilityPreview, IsEncodedOnceInThePng) {
  const TemporaryFolder folder;
  write_image(folder / "half.png", visibility_preview({1, 1, {"occlusion"}, {0.5f}}));
  // Linear one half is 187.5 of 255 in sRGB; a second encoding would make it 220.
  EXPECT_EQ(std::lround(read_image(folder / "half.png").pixels[0] * 255), 188);
}

}  // namespace
}  // namespace lkao::image::visibility_preview_test
