// The least and the most alpha of any part of an image, without a look at all of it.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>

#include "scene/holes.h"

namespace lkao::scene {

struct AlphaRange {
  double least, most;
};

// Least and most of 2 x 2 texels, of 2 x 2 of those, and so on: a third of the image's memory, as much again for both.
class TexelBounds {
 public:
  explicit TexelBounds(std::shared_ptr<const AlphaImage> image);

  // Bounds of what a texture with this image shows at texture coordinates in the box; 0 and 1 where they are too far
  // out for texels.
  AlphaRange of(const AlphaTexture& texture, const glm::dvec2& lower, const glm::dvec2& upper) const;

 private:
  struct Texel {
    std::uint16_t least, most;
  };
  struct Level {
    int width, height;
    std::vector<Texel> texels;
  };

  // Of columns and rows of texels, each from the first to the last.
  Texel of(const std::pair<int, int>& columns, const std::pair<int, int>& rows) const;

  std::shared_ptr<const AlphaImage> image_;
  std::vector<Level> levels_;  // the first is half the image
};

}  // namespace lkao::scene
