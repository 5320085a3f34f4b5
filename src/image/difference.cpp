#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "image/image.h"

namespace lkao::image {
namespace {

std::size_t index_of(const Image& image, const std::string& name) {
  const int channel = image.channel(name);
  if (channel < 0) throw std::invalid_argument("difference: an image has no channel '" + name + "'");
  return static_cast<std::size_t>(channel);
}

}  // namespace

Image difference(const Image& a, const Image& b, const std::vector<std::string>& channels) {
  if (a.width != b.width || a.height != b.height) throw std::invalid_argument("difference: images of two sizes");
  const std::size_t pixel_count = static_cast<std::size_t>(a.width) * static_cast<std::size_t>(a.height);
  const std::size_t stride = channels.size();
  Image result{a.width, a.height, channels, std::vector<float>(pixel_count * stride)};
  for (std::size_t c = 0; c < stride; ++c) {
    const std::size_t in_a = index_of(a, channels[c]), in_b = index_of(b, channels[c]);
    for (std::size_t pixel = 0; pixel < pixel_count; ++pixel) {
      result.pixels[pixel * stride + c] =
          b.pixels[pixel * b.channels.size() + in_b] - a.pixels[pixel * a.channels.size() + in_a];
    }
  }
  return result;
}

Image difference_preview(const Image& difference, float gain) {
  const std::size_t stride = difference.channels.size();
  Image preview{difference.width, difference.height, {"R", "G", "B"}, {}};
  preview.pixels.reserve(difference.pixels.size() / stride * 3);
  for (std::size_t first = 0; first < difference.pixels.size(); first += stride) {
    float sum = 0;
    for (std::size_t c = 0; c < stride; ++c) sum += difference.pixels[first + c];
    const float mean = sum / static_cast<float>(stride);
    // Not a difference at all: black.
    const float rest = std::isnan(mean) ? 0 : 1 - std::min(std::abs(mean) * gain, 1.0f);
    const bool is_above = mean > 0, is_below = mean < 0;
    preview.pixels.insert(preview.pixels.end(), {is_above ? 1 : rest, rest, is_below ? 1 : rest});
  }
  return preview;
}

}  // namespace lkao::image
