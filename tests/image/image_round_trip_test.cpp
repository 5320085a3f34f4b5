#include <cmath>
#include <cstdint>

#include <algorithm>
#include <bit>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "image/image.h"
#include "temporary_folder.h"

namespace lkao::image {
namespace {

using Names = std::vector<std::string>;

Names sorted(Names names) {
  std::sort(names.begin(), names.end());
  return names;
}

// Any 32 bits: NaNs with payloads, infinities and denormals among them.
Image random_bits(int width, int height, const Names& channels) {
  Image image{width, height, channels, {}};
  image.pixels.resize(static_cast<std::size_t>(width * height) * channels.size());
  std::mt19937 random(static_cast<unsigned>(width + height));
  for (float& value : image.pixels) value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
  return image;
}

// Equal bits under equal names, whatever the order of the channels.
void expect_same(const Image& a, const Image& b) {
  ASSERT_EQ(a.width, b.width);
  ASSERT_EQ(a.height, b.height);
  ASSERT_EQ(sorted(a.channels), sorted(b.channels));
  ASSERT_EQ(a.pixels.size(), b.pixels.size());
  const std::size_t count = a.channels.size();
  for (std::size_t c = 0; c < count; ++c) {
    const auto other = static_cast<std::size_t>(b.channel(a.channels[c]));
    for (std::size_t pixel = 0; pixel < a.pixels.size() / count; ++pixel) {
      const auto bits_a = std::bit_cast<std::uint32_t>(a.pixels[pixel * count + c]);
      const auto bits_b = std::bit_cast<std::uint32_t>(b.pixels[pixel * count + other]);
      ASSERT_EQ(bits_a, bits_b) << a.channels[c] << ", pixel " << pixel;
    }
  }
}

TEST(Image, FindsChannelsByName) {
  const Image image{1, 1, {"occlusion", "bent.X"}, {0, 0}};
  EXPECT_EQ(image.channel("occlusion"), 0);
  EXPECT_EQ(image.channel("bent.X"), 1);
  EXPECT_EQ(image.channel("bent"), -1);
}

TEST(ExrRoundTrip, KeepsSpecialValuesBitForBit) {
  using Limits = std::numeric_limits<float>;
  const float negative_nan = std::bit_cast<float>(0xffc12345u);
  const float signalling_nan = std::bit_cast<float>(0x7f812345u);
  const Image image{11,
                    1,
                    {"occlusion"},
                    {0.0f, -0.0f, Limits::denorm_min(), -Limits::denorm_min(), Limits::min(), Limits::max(),
                     Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN(), negative_nan, signalling_nan}};
  const TemporaryFolder folder;
  write_image(folder / "special.exr", image);
  expect_same(image, read_image(folder / "special.exr"));
}

TEST(ExrRoundTrip, KeepsNamesWithTheirValues) {
  // Neither in the order of the alphabet nor in that of colours; names that readers give a meaning to.
  const Names channels = {
      "occlusion", "bent.Z", "bent.X", "bent.Y", "normal.X", "normal.Y", "normal.Z",   "depth.Z",
      "A",         "B",      "G",      "R",      "Z",        "Y",        "visibility", "name with spaces"};
  const TemporaryFolder folder;
  const Image image = random_bits(7, 5, channels);
  write_image(folder / "channels.exr", image);
  expect_same(image, read_image(folder / "channels.exr"));
}

TEST(ExrRoundTrip, KeepsEverySize) {
  const TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 37}, {37, 1}, {17, 33}, {129, 65}}) {
    SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height));
    const Image image = random_bits(width, height, {"occlusion", "bent.X"});
    write_image(folder / "size.exr", image);
    expect_same(image, read_image(folder / "size.exr"));
  }
}

TEST(ExrRoundTrip, KeepsRowsFromTheTop) {
  const TemporaryFolder folder;
  write_image(folder / "rows.exr", {2, 2, {"occlusion"}, {1, 2, 3, 4}});
  EXPECT_EQ(read_image(folder / "rows.exr").pixels, (std::vector<float>{1, 2, 3, 4}));
}

TEST(ExrRoundTrip, SameImageSameFile) {
  const TemporaryFolder folder;
  const Image image = random_bits(9, 9, {"occlusion", "depth.Z"});
  write_image(folder / "a.exr", image);
  write_image(folder / "b.exr", image);
  EXPECT_EQ(bytes_of(folder / "a.exr"), bytes_of(folder / "b.exr"));
}

TEST(PngRoundTrip, KeepsAllEightBitValues) {
  Image image{256, 1, {"Y"}, {}};
  for (int i = 0; i < 256; ++i) image.pixels.push_back(static_cast<float>(i) / 255);
  const TemporaryFolder folder;
  write_image(folder / "ramp.png", image);
  const Image read = read_image(folder / "ramp.png");
  ASSERT_EQ(read.channel_count(), 1);
  ASSERT_EQ(read.pixels.size(), 256u);
  for (std::size_t i = 0; i < 256; ++i) EXPECT_NEAR(read.pixels[i] * 255, static_cast<float>(i), 1e-4);
}

TEST(PngRoundTrip, RoundsAndClamps) {
  using Limits = std::numeric_limits<float>;
  const Image image{
      8,
      1,
      {"Y"},
      {-1, 2, 0.49f / 255, 0.51f / 255, 254.49f / 255, Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()}};
  const TemporaryFolder folder;
  write_image(folder / "clamped.png", image);
  const Image read = read_image(folder / "clamped.png");
  const long expected[] = {0, 255, 0, 1, 254, 0, 255, 0};
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(std::lround(read.pixels[i] * 255), expected[i]) << i;
}

TEST(PngRoundTrip, StoresOneToFourChannelsAsTheyAre) {
  const TemporaryFolder folder;
  for (int count = 1; count <= 4; ++count) {
    SCOPED_TRACE(count);
    // The last channel is alpha to a PNG where there are 2 or 4: nothing may be multiplied by it.
    Image image{3, 2, Names{"R", "G", "B", "A"}, {}};
    image.channels.resize(static_cast<std::size_t>(count));
    for (int i = 0; i < 6 * count; ++i) image.pixels.push_back(static_cast<float>(i * 9 + 20) / 255);
    write_image(folder / "channels.png", image);
    const Image read = read_image(folder / "channels.png");
    ASSERT_EQ(read.channel_count(), count);
    ASSERT_EQ(read.pixels.size(), image.pixels.size());
    for (std::size_t i = 0; i < read.pixels.size(); ++i) EXPECT_NEAR(read.pixels[i], image.pixels[i], 1e-6) << i;
  }
}

TEST(WriteImage, TakesEndingsInAnyCase) {
  const TemporaryFolder folder;
  const Image image{1, 1, {"occlusion"}, {0.5f}};
  write_image(folder / "a.EXR", image);
  write_image(folder / "b.Png", image);
  EXPECT_EQ(read_image(folder / "a.EXR").pixels[0], 0.5f);
  EXPECT_EQ(std::lround(read_image(folder / "b.Png").pixels[0] * 255), 128);
}

// Not the moment of writing.
TEST(ExrFile, HasAlwaysTheSameDate) {
  const TemporaryFolder folder;
  write_image(folder / "a.exr", {1, 1, {"occlusion"}, {0.5f}});
  const std::string bytes = bytes_of(folder / "a.exr");
  EXPECT_NE(bytes.find("1970:01:01 00:00:00"), std::string::npos);
}

}  // namespace
}  // namespace lkao::image
