#include <algorithm>
#include <cmath>
#include <cstddef>

#include "image/image.h"

namespace lkao::image {

std::vector<std::uint16_t> alphas_of(const Image& image, bool or_brightness) {
  constexpr double kOpaque = 65535;
  const std::size_t size = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  // Red is as bright as the others where an image is grey.
  int channel = image.channel("A");
  if (channel < 0 && or_brightness) channel = 0;
  if (channel < 0) return std::vector<std::uint16_t>(size, static_cast<std::uint16_t>(kOpaque));
  std::vector<std::uint16_t> alphas;
  alphas.reserve(size);
  for (std::size_t i = 0; i < size; ++i) {
    const float alpha = image.pixels[i * image.channels.size() + static_cast<std::size_t>(channel)];
    alphas.push_back(static_cast<std::uint16_t>(std::lround(kOpaque * std::clamp(double{alpha}, 0.0, 1.0))));
  }
  return alphas;
}

}  // namespace lkao::image
