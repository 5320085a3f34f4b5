// The pass's own images: receivers, depth, masks.
#pragma once

#include <array>

#include "gpu/gl/objects.h"
#include "gpu/masks/units.h"

namespace lkao::gl {

// Of a picture, in textures that may be larger, since they grow only: pictures of several sizes may take turns.
class MaskImages {
 public:
  // `with_storage`: masks are gathered in shader storage, not by attachments.
  // Throws std::runtime_error where the driver cannot have them.
  void make_room(int width, int height, int layer_count, bool with_storage);

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
  void allocate(int width, int height, int layer_count, bool with_storage);
  void attach_masks() const;

  int width_ = 0, height_ = 0;                  // of the picture
  int texture_width_ = 0, texture_height_ = 0;  // 0: there are none
  int layer_count_ = 0;
  Texture receivers_, masks_, depth_;
  Framebuffer framebuffer_;
  std::array<Buffer, LKAO_STORAGE_MASKS_COUNT> storage_;
};

}  // namespace lkao::gl
