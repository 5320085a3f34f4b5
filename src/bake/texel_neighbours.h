// What a sampler reads beyond the edge of a map.
#pragma once

#include <algorithm>
#include <optional>

#include <glm/vec2.hpp>

#include "bake/texture_options.h"

namespace lkao::bake {

class TexelNeighbours {
 public:
  TexelNeighbours(int width, int height, const TextureOptions& options)
      : size_(width, height),
        repeats_u_(repeats(options.wrap_u, options)),
        repeats_v_(repeats(options.wrap_v, options)) {}

  // The texel itself inside of the map; beyond an edge that repeats, the one that is shown there; none beyond others.
  std::optional<glm::ivec2> at(const glm::ivec2& texel) const {
    const glm::ivec2 inside = wrapped(texel);
    if (inside.x < 0 || inside.y < 0 || inside.x >= size_.x || inside.y >= size_.y) return std::nullopt;
    return inside;
  }
  // The nearest one of the map beyond edges that do not repeat: clamped, and mirrored up to one texel away.
  glm::ivec2 nearest(const glm::ivec2& texel) const {
    const glm::ivec2 inside = wrapped(texel);
    return {std::clamp(inside.x, 0, size_.x - 1), std::clamp(inside.y, 0, size_.y - 1)};
  }

 private:
  static bool repeats(Wrap wrap, const TextureOptions& options) { return !options.udim && wrap == Wrap::repeat; }
  glm::ivec2 wrapped(glm::ivec2 texel) const {
    if (repeats_u_) texel.x = (texel.x % size_.x + size_.x) % size_.x;
    if (repeats_v_) texel.y = (texel.y % size_.y + size_.y) % size_.y;
    return texel;
  }

  glm::ivec2 size_;
  bool repeats_u_, repeats_v_;
};

}  // namespace lkao::bake
