// Images of alphas for tests, and a sampler that shares nothing with the library's.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>

#include <glm/vec2.hpp>

#include "scene/holes.h"

namespace lkao::scene {

// An "image file" of 8 bits: width, height and alphas, a byte each.
inline std::string alpha_file(int width, int height, const std::string& alphas) {
  return std::string{static_cast<char>(width), static_cast<char>(height)} + alphas;
}

inline AlphaImage decode_alpha_file(const std::string& name, std::string_view bytes, AlphaOf = AlphaOf::alpha) {
  if (bytes.size() < 2) throw std::runtime_error("cannot read '" + name + "': it is short");
  AlphaImage image{.width = bytes[0], .height = bytes[1], .alphas = {}};
  bytes.remove_prefix(2);
  for (const char c : bytes) image.alphas.push_back(static_cast<std::uint16_t>(257 * static_cast<unsigned char>(c)));
  return image;
}

// The same every time: the engine alone decides, not the standard library.
inline std::string random_alphas(int count) {
  std::mt19937 engine(3);
  std::string alphas;
  for (int i = 0; i < count; ++i) alphas += static_cast<char>(engine() >> 24);
  return alphas;
}

inline AlphaTexture random_texture(int width, int height, TextureWraps wraps, bool is_smooth) {
  const std::string file = alpha_file(width, height, random_alphas(width * height));
  return {std::make_shared<const AlphaImage>(decode_alpha_file("", file)), wraps, is_smooth};
}

// The texel that stands at `i`, step by step.
inline int plain_wrap(int i, int count, TextureWrap wrap) {
  if (wrap == TextureWrap::clamp) return std::max(0, std::min(i, count - 1));
  bool is_backwards = false;
  for (; i < 0; i += count) is_backwards = !is_backwards;
  for (; i >= count; i -= count) is_backwards = !is_backwards;
  return is_backwards && wrap == TextureWrap::mirror ? count - 1 - i : i;
}

inline double plain_alpha(const AlphaTexture& texture, const glm::dvec2& uv) {
  const AlphaImage& image = *texture.image;
  const auto at = [&](int x, int y) {
    x = plain_wrap(x, image.width, texture.wraps.u);
    y = plain_wrap(y, image.height, texture.wraps.v);
    return image.alphas.at(static_cast<std::size_t>(y * image.width + x)) / 65535.0;
  };
  const glm::dvec2 p(uv.x * image.width, uv.y * image.height);
  if (!texture.is_smooth) return at(static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y)));
  const int x = static_cast<int>(std::floor(p.x - 0.5)), y = static_cast<int>(std::floor(p.y - 0.5));
  const double s = p.x - 0.5 - x, t = p.y - 0.5 - y;
  return (1 - s) * (1 - t) * at(x, y) + s * (1 - t) * at(x + 1, y) + (1 - s) * t * at(x, y + 1) +
         s * t * at(x + 1, y + 1);
}

}  // namespace lkao::scene
