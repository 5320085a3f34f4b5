#include "gpu/screen/splat/splat_images.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "gpu/frame/grown_size.h"
#include "gpu/gl/error.h"
#include "gpu/screen/splat/units.h"

namespace lkao::gl {

void SplatImages::make_room(int width, int height, int layer_count) {
  if (width > texture_width_ || height > texture_height_ || layer_count > layer_count_) {
    const Size size = grown_size({width, height}, {texture_width_, texture_height_});
    const int most_layers = std::max(layer_count, layer_count_);
    // The old ones first: there may not be room for both.
    *this = SplatImages();
    allocate(size.width, size.height, most_layers);
  }
  width_ = width;
  height_ = height;
}

void SplatImages::allocate(int width, int height, int layer_count) {
  receivers_ = make_texture(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(receivers_.name(), 1, GL_RGBA32F, width, height, LKAO_SCREEN_LAYER_COUNT);
  pixel_spheres_ = make_texture(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(pixel_spheres_.name(), 1, GL_RGBA32F, width, height, layer_count);
  sum_ = make_texture(GL_TEXTURE_2D);
  glTextureStorage2D(sum_.name(), 1, GL_R32F, width, height);
  sum_framebuffer_ = make_framebuffer();
  glNamedFramebufferTexture(sum_framebuffer_.name(), GL_COLOR_ATTACHMENT0, sum_.name(), 0);
  check_errors("making room for a SplatPass");
  texture_width_ = width;
  texture_height_ = height;
  layer_count_ = layer_count;
}

}  // namespace lkao::gl
