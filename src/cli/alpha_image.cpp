#include "cli/alpha_image.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "image/image.h"

namespace lkao::cli {

scene::AlphaImage decode_alpha(const std::string& name, std::string_view bytes, scene::AlphaOf what) {
  constexpr double kOpaque = 65535;
  const image::Image image = image::decode_image(name, bytes);
  scene::AlphaImage result{.width = image.width, .height = image.height, .alphas = {}};
  const auto size = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  // Red is as bright as the others where an image is grey.
  int channel = image.channel("A");
  if (channel < 0 && what == scene::AlphaOf::alpha_or_grey) channel = 0;
  if (channel < 0) {
    result.alphas.assign(size, static_cast<std::uint16_t>(kOpaque));
    return result;
  }
  result.alphas.reserve(size);
  for (std::size_t i = 0; i < size; ++i) {
    const float alpha = image.pixels[i * image.channels.size() + static_cast<std::size_t>(channel)];
    result.alphas.push_back(static_cast<std::uint16_t>(std::lround(kOpaque * std::clamp(double{alpha}, 0.0, 1.0))));
  }
  return result;
}

}  // namespace lkao::cli
