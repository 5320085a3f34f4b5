#include <cmath>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "image/image.h"

namespace lkao::image {
namespace {

using Colour = std::array<float, 3>;

// sRGB-encoded. Blue, so that nobody takes it for a grey.
constexpr Colour kBackground = {0.11f, 0.13f, 0.17f};

// IEC 61966-2-1.
double encode_srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

Colour colour_of(float occlusion) {
  if (std::isnan(occlusion)) return kBackground;
  const auto grey = static_cast<float>(encode_srgb(std::clamp(1.0 - occlusion, 0.0, 1.0)));
  return {grey, grey, grey};
}

int occlusion_channel(const Image& image) {
  const int named = image.channel("occlusion");
  if (named < 0 && image.channel_count() != 1) {
    throw std::invalid_argument("visibility preview: the image has no channel 'occlusion'");
  }
  return std::max(named, 0);
}

}  // namespace

Image visibility_preview(const Image& occlusion) {
  const auto stride = static_cast<std::size_t>(occlusion.channel_count());
  Image preview{occlusion.width, occlusion.height, {"R", "G", "B"}, {}};
  preview.pixels.reserve(static_cast<std::size_t>(preview.width) * static_cast<std::size_t>(preview.height) * 3);
  for (auto i = static_cast<std::size_t>(occlusion_channel(occlusion)); i < occlusion.pixels.size(); i += stride) {
    const Colour colour = colour_of(occlusion.pixels[i]);
    preview.pixels.insert(preview.pixels.end(), colour.begin(), colour.end());
  }
  return preview;
}

}  // namespace lkao::image
