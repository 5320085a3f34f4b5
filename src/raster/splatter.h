// Splats on what a camera of the program sees: a context, a view, a pass, and the time of its frames.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "lkao/gl.h"
#include "raster/view_textures.h"
#include "scene/camera.h"

namespace lkao::raster {

// As Rasterizer: a thread has one at a time, and every member is called in that thread.
class Splatter {
 public:
  // Throws std::runtime_error where EGL offers no such device.
  explicit Splatter(gl::Device device = gl::Device::automatic);

  const gl::HeadlessContext& context() const { return *context_; }
  // To give it spheres.
  gl::SplatPass& pass() { return *pass_; }

  // `behind`: a second layer of the scene, of the same size; none: there is none.
  void set_view(const scene::Camera& camera, const scene::ReceiverImage& image,
                const std::optional<scene::ReceiverImage>& behind = {});

  // One frame, with nothing else under way; returns its seconds. Needs set_view().
  double draw(const gl::SplatOptions& options);

  // Of the last frame, one a pixel, row by row from the top; NaN where there is no receiver.
  std::vector<float> read_occlusion() const;

 private:
  std::unique_ptr<gl::HeadlessContext> context_;  // first: it outlives what is in it
  gl::Camera camera_;
  std::optional<ViewTextures> textures_, behind_;
  std::optional<gl::SplatPass> pass_;
};

}  // namespace lkao::raster
