// The volume pass's own images: receivers, their depth, accessibility.
#pragma once

#include "gpu/gl/objects.h"
#include "lkao/gl/volume_pass.h"

namespace lkao::gl {

// Of a picture, in textures that may be larger, as MaskImages has them.
class VolumeImages {
 public:
  // `with_ups`: geometric normals are wanted. Throws std::runtime_error where the driver cannot have such images.
  void make_room(int width, int height, Accessibility format, bool with_ups);

  int width() const { return width_; }
  int height() const { return height_; }

  // To draw the receivers.
  void bind_receivers() const;
  // To draw volumes: all accessible, receivers for shaders to read.
  void bind_accessibility(const Sampler& plain_sampler) const;
  // For shaders to read.
  void bind_result(const Sampler& plain_sampler) const;

 private:
  void allocate(int width, int height, Accessibility format, bool with_ups);
  void bind_framebuffer(const Framebuffer& framebuffer) const;

  int width_ = 0, height_ = 0;                  // of the picture
  int texture_width_ = 0, texture_height_ = 0;  // 0: there are none
  Texture origins_, axes_, ups_, depth_, accessibility_;
  Framebuffer receivers_framebuffer_, accessibility_framebuffer_;
};

}  // namespace lkao::gl
