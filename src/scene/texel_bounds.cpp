#include "scene/texel_bounds.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lkao::scene {

namespace {

constexpr double kFarthest = 1e9;  // beyond, numbers of texels are coarse

// Runs of texels of an image, each from the first to the last.
struct Runs {
  std::pair<int, int> runs[3];
  int count = 0;

  void add(int first, int last) { runs[count++] = {first, last}; }
};

// What an axis of `size` texels shows from texel `first` to `last` of the endless plane.
Runs runs_of(double first, double last, int size, TextureWrap wrap) {
  Runs runs;
  const double end = size - 1;
  if (wrap == TextureWrap::clamp) {
    runs.add(static_cast<int>(std::clamp(first, 0.0, end)), static_cast<int>(std::clamp(last, 0.0, end)));
    return runs;
  }
  if (last - first >= end) {
    runs.add(0, size - 1);
    return runs;
  }
  // In the copy of the image where the first is, and in the next one.
  const double copy = std::floor(first / size);
  for (int k = 0; k < 2; ++k) {
    const double begin = (copy + k) * size;
    const int low = static_cast<int>(std::max(first - begin, 0.0)),
              high = static_cast<int>(std::min(last - begin, end));
    if (low > high) continue;
    const bool is_mirrored = wrap == TextureWrap::mirror && std::fmod(std::fabs(copy + k), 2.0) == 1;
    if (is_mirrored) {
      runs.add(size - 1 - high, size - 1 - low);
    } else {
      runs.add(low, high);
    }
  }
  return runs;
}

}  // namespace

TexelBounds::TexelBounds(std::shared_ptr<const AlphaImage> image) : image_(std::move(image)) {
  int width = image_->width, height = image_->height;
  while (width > 1 || height > 1) {
    Level level{(width + 1) / 2, (height + 1) / 2, {}};
    level.texels.reserve(static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height));
    for (int row = 0; row < level.height; ++row) {
      for (int column = 0; column < level.width; ++column) {
        Texel bounds{65535, 0};
        for (int y = 2 * row; y < std::min(2 * row + 2, height); ++y) {
          for (int x = 2 * column; x < std::min(2 * column + 2, width); ++x) {
            const std::size_t i =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
            const Texel part = levels_.empty() ? Texel{image_->alphas[i], image_->alphas[i]} : levels_.back().texels[i];
            bounds = {std::min(bounds.least, part.least), std::max(bounds.most, part.most)};
          }
        }
        level.texels.push_back(bounds);
      }
    }
    width = level.width;
    height = level.height;
    levels_.push_back(std::move(level));
  }
}

AlphaRange TexelBounds::of(const AlphaTexture& texture, const glm::dvec2& lower, const glm::dvec2& upper) const {
  // Smooth images show the texels on both sides, from the middle of each on; and rounding puts little beyond the box.
  constexpr double kRounding = 1e-6;
  const double before = texture.is_smooth ? 0.5 + kRounding : kRounding, behind = texture.is_smooth ? 1 : 0;
  const double after = texture.is_smooth ? kRounding - 0.5 : kRounding;
  const double left = std::floor(lower.x * image_->width - before),
               right = std::floor(upper.x * image_->width + after) + behind,
               top = std::floor(lower.y * image_->height - before),
               bottom = std::floor(upper.y * image_->height + after) + behind;
  const double far = std::max(std::max(std::fabs(left), std::fabs(right)), std::max(std::fabs(top), std::fabs(bottom)));
  if (!(left <= right && top <= bottom && far < kFarthest)) return {0, 1};
  const Runs columns = runs_of(left, right, image_->width, texture.wraps.u),
             rows = runs_of(top, bottom, image_->height, texture.wraps.v);
  Texel bounds{65535, 0};
  for (int i = 0; i < columns.count; ++i) {
    for (int k = 0; k < rows.count; ++k) {
      const Texel part = of(columns.runs[i], rows.runs[k]);
      bounds = {std::min(bounds.least, part.least), std::max(bounds.most, part.most)};
    }
  }
  return {bounds.least / 65535.0, bounds.most / 65535.0};
}

TexelBounds::Texel TexelBounds::of(const std::pair<int, int>& columns, const std::pair<int, int>& rows) const {
  // On the level where that is a few texels.
  constexpr int kFew = 6;
  std::size_t shift = 0;
  while (shift < levels_.size() && ((columns.second >> shift) - (columns.first >> shift) > kFew ||
                                    (rows.second >> shift) - (rows.first >> shift) > kFew)) {
    ++shift;
  }
  const int width = shift == 0 ? image_->width : levels_[shift - 1].width;
  Texel bounds{65535, 0};
  for (int y = rows.first >> shift; y <= rows.second >> shift; ++y) {
    for (int x = columns.first >> shift; x <= columns.second >> shift; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      const Texel part = shift == 0 ? Texel{image_->alphas[i], image_->alphas[i]} : levels_[shift - 1].texels[i];
      bounds = {std::min(bounds.least, part.least), std::max(bounds.most, part.most)};
    }
  }
  return bounds;
}

}  // namespace lkao::scene
