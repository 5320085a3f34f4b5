// The pass's own images: receivers, depth, masks.
#pragma once

#include <array>

#include "gpu/gl/objects.h"
#include "gpu/masks/units.h"

namespace lkao::gl {

class MaskImages {
 public:
  MaskImages() = default;
  // `with_storage`: masks are gathered in shader storage, not by attachments.
  // Throws std::runtime_error where the driver cannot have them.
  MaskImages(int width, int height, int layer_count, bool with_storage);

  // False for those that were made without arguments.
  bool fits(int width, int height, int layer_count) const;
  int width() const { return width_; }
  int height() const { return height_; }
  int layer_count() const { return layer_count_; }
  GLuint receivers() const { return receivers_.name(); }
  GLuint masks() const { return masks_.name(); }

  // For drawing the receivers' depths.
  void bind_depth() const;
  // With all masks empty. Storage is bound where there is some.
  void bind_masks() const;
  // Where masks were gathered in storage: puts them into the texture.
  void finish_masks() const;

 private:
  int width_ = 0;
  int height_ = 0;
  int layer_count_ = 0;
  Texture receivers_, masks_, depth_;
  Framebuffer framebuffer_;
  std::array<Buffer, LKAO_STORAGE_MASKS_COUNT> storage_;
};

}  // namespace lkao::gl
