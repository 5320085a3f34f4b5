#include "cli/gltf_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "image/image.h"
#include "scene/occlusion_colour.h"

namespace lkao::cli {
namespace {

// Where the middle of a pixel of one size lies among those of another, along one axis: between two of them.
struct Between {
  int low, high;
  float share;  // of the high one

  Between(int pixel, int size, int other_size) {
    const double middle = (pixel + 0.5) * other_size / size - 0.5;
    const double floor = std::floor(middle);
    low = std::clamp(static_cast<int>(floor), 0, other_size - 1);
    high = std::clamp(static_cast<int>(floor) + 1, 0, other_size - 1);
    share = static_cast<float>(middle - floor);
  }
  float mix(float a, float b) const { return a == b ? a : a + (b - a) * share; }
};

image::Image resized(const image::Image& image, int width, int height) {
  if (image.width == width && image.height == height) return image;
  image::Image result{width, height, image.channels, {}};
  const int channel_count = image.channel_count();
  result.pixels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * image.channels.size());
  const auto at = [&](int x, int y, int channel) {
    const std::size_t pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x);
    return image.pixels[pixel * image.channels.size() + static_cast<std::size_t>(channel)];
  };
  for (int y = 0; y < height; ++y) {
    const Between rows(y, height, image.height);
    for (int x = 0; x < width; ++x) {
      const Between columns(x, width, image.width);
      for (int c = 0; c < channel_count; ++c) {
        result.pixels.push_back(rows.mix(columns.mix(at(columns.low, rows.low, c), at(columns.high, rows.low, c)),
                                         columns.mix(at(columns.low, rows.high, c), at(columns.high, rows.high, c))));
      }
    }
  }
  return result;
}

image::Image visibility_of(int width, int height, const std::vector<float>& occlusion) {
  image::Image image{width, height, {"R"}, {}};
  image.pixels.reserve(occlusion.size());
  for (const float value : occlusion) {
    image.pixels.push_back(static_cast<float>(scene::grey_of(value, scene::ColourCoding::linear)));
  }
  return image;
}

// Of a grey image the one channel.
float channel_of(const image::Image& image, std::size_t pixel, int channel) {
  return image
      .pixels[pixel * image.channels.size() + static_cast<std::size_t>(image.channel_count() < 3 ? 0 : channel)];
}

}  // namespace

std::string make_map_png(int width, int height, const std::vector<float>& occlusion,
                         const std::optional<scene::PackedImage>& packed, const std::string& name) {
  image::Image visibility = visibility_of(width, height, occlusion);
  if (!packed) return image::encode_png(name, visibility);
  image::Image other = image::decode_image(packed->name, packed->bytes);
  const int wide = std::max(width, other.width), high = std::max(height, other.height);
  visibility = resized(visibility, wide, high);
  other = resized(other, wide, high);
  image::Image result{wide, high, {"R", "G", "B"}, {}};
  result.pixels.reserve(3 * visibility.pixels.size());
  for (std::size_t i = 0; i < visibility.pixels.size(); ++i) {
    result.pixels.insert(result.pixels.end(), {visibility.pixels[i], channel_of(other, i, 1), channel_of(other, i, 2)});
  }
  return image::encode_png(name, result);
}

}  // namespace lkao::cli
