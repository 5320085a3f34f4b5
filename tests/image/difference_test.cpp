#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "image/image.h"

namespace lkao::image {
namespace {

TEST(Difference, IsOfTheSecondFromTheFirstByName) {
  const Image a{2, 1, {"occlusion", "depth.Z"}, {0.25f, 1, 0.5f, 2}};
  const Image b{2, 1, {"depth.Z", "occlusion"}, {4, 0.5f, 8, 0.25f}};
  const Image both = difference(a, b, {"occlusion", "depth.Z"});
  EXPECT_EQ(both.channels, a.channels);
  EXPECT_EQ(both.pixels, (std::vector<float>{0.25f, 3, -0.25f, 6}));
  EXPECT_EQ(difference(a, b, {"depth.Z"}).pixels, (std::vector<float>{3, 6}));
}

TEST(Difference, ThrowsForImagesThatDoNotMatch) {
  const Image a{2, 1, {"Y"}, {0, 0}}, tall{1, 2, {"Y"}, {0, 0}}, other{2, 1, {"Z"}, {0, 0}};
  EXPECT_THROW(difference(a, tall, {"Y"}), std::invalid_argument);
  EXPECT_THROW(difference(a, other, {"Y"}), std::invalid_argument);
}

TEST(DifferencePreview, IsWhiteRedAboveAndBlueBelow) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Image preview = difference_preview({6, 1, {"Y"}, {0, 0.25f, -0.25f, 0.5f, -7, nan}}, 2);
  EXPECT_EQ(preview.channels, (std::vector<std::string>{"R", "G", "B"}));
  const std::vector<float> expected = {1, 1, 1, 1, 0.5f, 0.5f, 0.5f, 0.5f, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0};
  EXPECT_EQ(preview.pixels, expected);
}

TEST(DifferencePreview, TakesTheMeanOfSeveralChannels) {
  const Image preview = difference_preview({1, 1, {"R", "G"}, {0.75f, -0.25f}}, 1);
  EXPECT_EQ(preview.pixels, (std::vector<float>{1, 0.75f, 0.75f}));
}

}  // namespace
}  // namespace lkao::image
