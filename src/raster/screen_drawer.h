// Passes in screen space on what a camera of the program sees: a context, a view, what smooths the result, and the time
// of a frame.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "lkao/gl.h"
#include "raster/view_textures.h"
#include "scene/camera.h"

namespace lkao::raster {

// What becomes of a pass's occlusion.
struct Smoothing {
  int step = 1;           // the pass answers every step-th pixel along each axis; the others are upsampled
  int filter_radius = 0;  // of BilateralFilterOptions; 0: none
};

// As Rasterizer: a thread has one at a time, and every member is called in that thread.
class ScreenDrawer {
 public:
  using Pass = std::function<void(const gl::GBuffer&, const gl::Camera&, const gl::OcclusionTarget&)>;

  // Throws std::runtime_error where EGL offers no such device.
  explicit ScreenDrawer(gl::Device device = gl::Device::automatic);

  const gl::HeadlessContext& context() const { return *context_; }
  void set_view(const scene::Camera& camera, const scene::ReceiverImage& image);

  // One frame, with nothing else under way; returns its seconds. Needs set_view().
  double draw(const Pass& pass, const Smoothing& smoothing);

  // Of the last frame, one a pixel, row by row from the top; NaN where there is no receiver.
  std::vector<float> read_occlusion() const;

 private:
  void draw_stepped(const Pass& pass, const gl::GBuffer& g_buffer, const Smoothing& smoothing);
  void make_samples(const gl::GBuffer& g_buffer);

  std::unique_ptr<gl::HeadlessContext> context_;  // first: it outlives what is in it
  gl::Camera camera_;
  std::optional<ViewTextures> textures_;
  std::optional<gl::BilateralFilter> filter_;
  gl::Texture samples_;  // what the pass answers where that is not all pixels
  int sample_width_ = 0, sample_height_ = 0;
};

}  // namespace lkao::raster
