// The images of a splat pass.
#pragma once

#include "gpu/gl/objects.h"

namespace lkao::gl {

// Of a picture, in textures that may be larger, as MaskImages has them.
class SplatImages {
 public:
  // Does nothing where there is room already. One with more layers stays as it is.
  void make_room(int width, int height, int layer_count);

  int width() const { return width_; }
  int height() const { return height_; }
  const Texture& receivers() const { return receivers_; }          // LKAO_SCREEN_*
  const Texture& pixel_spheres() const { return pixel_spheres_; }  // a layer of the scene each
  const Texture& sum() const { return sum_; }
  const Framebuffer& sum_framebuffer() const { return sum_framebuffer_; }

 private:
  void allocate(int width, int height, int layer_count);

  int width_ = 0, height_ = 0;                                    // of the picture
  int texture_width_ = 0, texture_height_ = 0, layer_count_ = 0;  // 0: there are none
  Texture receivers_, pixel_spheres_, sum_;
  Framebuffer sum_framebuffer_;
};

}  // namespace lkao::gl
