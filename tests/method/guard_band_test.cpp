// A picture with a margin is the picture, and more around it.
#include "method/guard_band.h"

#include <cstddef>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "scene/builtin.h"

namespace lkao::method {
namespace {

constexpr int kWidth = 40;
constexpr int kHeight = 22;
constexpr int kMargin = 7;

class GuardBand : public ::testing::Test {
 protected:
  // The pixel of the wide picture that a pixel of the narrow one is.
  static std::size_t in_wide(std::size_t pixel) {
    const std::size_t x = pixel % kWidth, y = pixel / kWidth;
    return (y + kMargin) * (kWidth + 2 * kMargin) + x + kMargin;
  }

  const scene::Mesh mesh_ = scene::make_builtin("box");
  const scene::Camera camera_{.eye = {0.7f, 1.2f, 3}, .target = {0.1f, 0.2f, 0}, .up = {0.1f, 1, 0}, .fov = 70};
  const scene::ReceiverImage image_ = scene::find_receivers(mesh_, camera_, kWidth, kHeight);
  const GuardedView wide_ = widen(mesh_, camera_, image_, kMargin);
};

TEST_F(GuardBand, HasTheVeryReceiversInTheMiddle) {
  ASSERT_EQ(wide_.image.width, kWidth + 2 * kMargin);
  ASSERT_EQ(wide_.image.height, kHeight + 2 * kMargin);
  ASSERT_GT(image_.receiver_count, std::size_t{kWidth * kHeight / 4});
  for (std::size_t pixel = 0; pixel < image_.receivers.size(); ++pixel) {
    if (!image_.sees(pixel)) continue;
    EXPECT_EQ(wide_.image.receivers[in_wide(pixel)].position, image_.receivers[pixel].position);
    EXPECT_EQ(wide_.image.depth[in_wide(pixel)], image_.depth[pixel]);
  }
}

// The wider camera looks through the same places: what it finds by itself are nearly the same points.
TEST_F(GuardBand, PixelsAreAsLarge) {
  const scene::ReceiverImage own =
      scene::find_receivers(mesh_, wide_.camera, kWidth + 2 * kMargin, kHeight + 2 * kMargin);
  std::size_t off_count = 0;
  for (std::size_t pixel = 0; pixel < image_.receivers.size(); ++pixel) {
    const std::size_t wide = in_wide(pixel);
    const bool is_alike = own.sees(wide) == image_.sees(pixel);
    const glm::vec3 off = own.receivers[wide].position - image_.receivers[pixel].position;
    off_count += !is_alike || (image_.sees(pixel) && glm::dot(off, off) > 1e-8f);
  }
  EXPECT_LE(off_count, 3u);  // at edges
}

TEST_F(GuardBand, IsThrownAway) {
  std::vector<float> frame(wide_.image.receivers.size(), -1);
  for (std::size_t pixel = 0; pixel < image_.receivers.size(); ++pixel) {
    frame[in_wide(pixel)] = static_cast<float>(pixel);
  }
  const std::vector<float> middle = without_margin(frame, kWidth + 2 * kMargin, kMargin);
  ASSERT_EQ(middle.size(), image_.receivers.size());
  for (std::size_t pixel = 0; pixel < middle.size(); ++pixel) EXPECT_EQ(middle[pixel], static_cast<float>(pixel));
  EXPECT_EQ(without_margin(frame, kWidth + 2 * kMargin, 0), frame);
}

}  // namespace
}  // namespace lkao::method
