#include "raster/screen_drawer.h"

#include <algorithm>
#include <stdexcept>

#include "gpu/gl/error.h"
#include "raster/camera.h"
#include "raster/timed_frame.h"

namespace lkao::raster {

ScreenDrawer::ScreenDrawer(gl::Device device) : context_(std::make_unique<gl::HeadlessContext>(device)) {
  context_->make_current();
  filter_.emplace();
}

void ScreenDrawer::set_view(const scene::Camera& camera, const scene::ReceiverImage& image) {
  textures_.reset();  // the old ones first: there may not be room for both
  textures_.emplace(image);
  camera_ = gl_camera(camera, image.width, image.height);
}

void ScreenDrawer::make_samples(const gl::GBuffer& g_buffer) {
  const int width = g_buffer.picture_width(), height = g_buffer.picture_height();
  if (width == sample_width_ && height == sample_height_) return;
  samples_ = gl::make_texture(GL_TEXTURE_2D);
  glTextureStorage2D(samples_.name(), 1, GL_R32F, width, height);
  gl::check_errors("making room for the samples of a view");
  sample_width_ = width;
  sample_height_ = height;
}

void ScreenDrawer::draw_stepped(const Pass& pass, const gl::GBuffer& g_buffer, const Smoothing& smoothing) {
  const gl::OcclusionTarget samples{.texture = samples_.name()}, all = textures_->targets(false).occlusion;
  pass(g_buffer, camera_, samples);
  filter_->upsample(g_buffer, camera_, samples, all, {.radius = std::max(smoothing.filter_radius, smoothing.step)});
}

double ScreenDrawer::draw(const Pass& pass, const Smoothing& smoothing) {
  if (!textures_) throw std::runtime_error("no view: call set_view() first");
  gl::GBuffer g_buffer = textures_->g_buffer();
  const gl::OcclusionTarget target = textures_->targets(false).occlusion;
  if (smoothing.step > 1) {
    g_buffer.step = smoothing.step;
    make_samples(g_buffer);
    return seconds_of([&] { draw_stepped(pass, g_buffer, smoothing); });
  }
  return seconds_of([&] {
    pass(g_buffer, camera_, target);
    if (smoothing.filter_radius > 0) {
      filter_->filter(g_buffer, camera_, target, target, {.radius = smoothing.filter_radius});
    }
  });
}

std::vector<float> ScreenDrawer::read_occlusion() const {
  if (!textures_) throw std::runtime_error("no view: call set_view() first");
  return textures_->read_occlusion();
}

}  // namespace lkao::raster
