// The volume pass's own images: receivers, their depth, accessibility.
#pragma once

#include "gpu/gl/objects.h"
#include "lkao/gl/volume_pass.h"

namespace lkao::gl {

class VolumeImages {
 public:
  VolumeImages() = default;
  // Throws std::runtime_error where the driver cannot have them.
  VolumeImages(int width, int height, Accessibility format, bool with_ups);

  // False for those that were made without arguments. `with_ups`: geometric normals are wanted.
  bool fit(int width, int height, bool with_ups) const;
  int width() const { return width_; }
  int height() const { return height_; }

  // To draw the receivers.
  void bind_receivers() const;
  // To draw volumes: all accessible, receivers for shaders to read.
  void bind_accessibility(const Sampler& plain_sampler) const;
  // For shaders to read.
  void bind_result(const Sampler& plain_sampler) const;

 private:
  int width_ = 0;
  int height_ = 0;
  Texture origins_, axes_, ups_, depth_, accessibility_;
  Framebuffer receivers_framebuffer_, accessibility_framebuffer_;
};

}  // namespace lkao::gl
