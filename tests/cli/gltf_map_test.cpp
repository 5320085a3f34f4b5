#include "cli/gltf_map.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "image/image.h"

namespace lkao::cli {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

image::Image read(const std::string& png) { return image::decode_image("a map", png); }

TEST(GltfMap, IsTheVisibilityAsItIs) {
  const image::Image map = read(make_map_png(3, 2, {0, 1, 0.2f, 0.6f, kNaN, 2}, {}, "a map"));
  EXPECT_EQ(map.width, 3);
  EXPECT_EQ(map.height, 2);
  ASSERT_EQ(map.channel_count(), 1);
  const float expected[] = {1, 0, 0.8f, 0.4f, 0, 0};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(map.pixels[i], expected[i], 1e-6) << i;
}

TEST(GltfMap, KeepsRoughnessAndMetal) {
  const image::Image looks{2, 1, {"R", "G", "B"}, {0.2f, 0.4f, 0.6f, 1, 0.8f, 0}};
  const scene::PackedImage packed{"looks", image::encode_png("looks", looks)};
  const image::Image map = read(make_map_png(2, 1, {0.8f, 1}, packed, "a map"));
  ASSERT_EQ(map.channel_count(), 3);
  const float expected[] = {0.2f, 0.4f, 0.6f, 0, 0.8f, 0};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(map.pixels[i], expected[i], 1e-6) << i;
}

TEST(GltfMap, HasTheLargerSizeOfBoth) {
  const image::Image looks{1, 4, {"R", "G", "B"}, {0, 1, 0.2f, 0, 0, 0.2f, 0, 0, 0.2f, 0, 1, 0.2f}};
  const scene::PackedImage packed{"looks", image::encode_png("looks", looks)};
  const image::Image map = read(make_map_png(2, 2, {0, 1, 1, 1}, packed, "a map"));
  EXPECT_EQ(map.width, 2);
  EXPECT_EQ(map.height, 4);
  const float red[] = {1, 0, 0.75f, 0, 0.25f, 0, 0, 0};
  const float green[] = {1, 1, 0, 0, 0, 0, 1, 1};
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(map.pixels[3 * i], red[i], 0.5 / 255 + 1e-6) << i;
    EXPECT_NEAR(map.pixels[3 * i + 1], green[i], 1e-6) << i;
    EXPECT_NEAR(map.pixels[3 * i + 2], 0.2, 1e-6) << i;
  }
}

TEST(GltfMap, DamagedImagesAreNamed) {
  std::string png = image::encode_png("looks", {1, 1, {"R"}, {0}});
  const auto fault_of = [](const std::string& bytes) -> std::string {
    try {
      make_map_png(1, 1, {0}, scene::PackedImage{"model.glb: images[0]", bytes}, "a map");
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(fault_of(png), "");
  EXPECT_EQ(fault_of(png.substr(0, png.size() - 20)), "cannot read 'model.glb: images[0]': the PNG file is cut off");
  EXPECT_TRUE(fault_of("\xff\xd8 is no JPEG").starts_with("cannot read 'model.glb: images[0]': "));
}

}  // namespace
}  // namespace lkao::cli
