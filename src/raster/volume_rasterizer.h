// Ambient occlusion volumes on what a camera of the program sees: a context, a view, a pass, and the time of its
// frames.
#pragma once

#include <optional>
#include <vector>

#include "lkao/gl.h"
#include "raster/view_textures.h"
#include "scene/camera.h"
#include "scene/mesh.h"

namespace lkao::raster {

// In any order: set_view(), set_occluders() and start_pass(), as often as wanted; then draw(). Threads and errors as
// for Rasterizer.
class VolumeRasterizer {
 public:
  // Throws std::runtime_error where EGL offers no such device.
  explicit VolumeRasterizer(gl::Device device = gl::Device::automatic);

  const gl::HeadlessContext& context() const { return context_; }

  void set_view(const scene::Camera& camera, const scene::ReceiverImage& image);
  // All of one opacity.
  void set_occluders(const scene::Mesh& mesh, float opacity = 1);
  // Of step x step pixels one is drawn, and the others are found by the cross-bilateral filter; 1: all are drawn.
  void start_pass(const gl::VolumePassSetup& setup, int step = 1);
  // To read what the last frame left. Needs start_pass().
  gl::VolumePass& pass();

  // One frame, with nothing else under way; returns its seconds. Receivers start where the query's do.
  double draw(const RayOptions& options, const gl::VolumeOptions& volumes = {});
  // Of the last frame, one a pixel, row by row from the top; NaN where there is no receiver.
  std::vector<float> read_occlusion() const;

 private:
  gl::HeadlessContext context_;  // first: it outlives what is in it
  gl::Camera camera_;
  std::optional<ViewTextures> textures_;
  std::optional<gl::Occluders> occluders_;
  std::optional<gl::VolumePass> pass_;
  std::optional<gl::BilateralFilter> filter_;
  int step_ = 1;
};

}  // namespace lkao::raster
