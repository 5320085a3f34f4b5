#include "raster/volume_rasterizer.h"

#include <epoxy/gl.h>

#include <stdexcept>

#include "gpu/gl/objects.h"
#include "raster/camera.h"
#include "raster/timed_frame.h"

namespace lkao::raster {

VolumeRasterizer::VolumeRasterizer(gl::Device device) : context_(device) { context_.make_current(); }

void VolumeRasterizer::set_view(const scene::Camera& camera, const scene::ReceiverImage& image) {
  textures_.reset();  // the old ones first: there may not be room for both
  textures_.emplace(image);
  camera_ = gl_camera(camera, image.width, image.height);
}

void VolumeRasterizer::set_occluders(const scene::Mesh& mesh, float opacity) {
  occluders_.reset();
  occluders_.emplace(mesh.positions, mesh.triangles);
  if (opacity < 1) occluders_->set_opacities(std::vector<float>(mesh.triangles.size(), opacity));
}

void VolumeRasterizer::start_pass(const gl::VolumePassSetup& setup, int step) {
  pass_.reset();
  pass_.emplace(setup);
  if (step > 1 && !filter_) filter_.emplace();
  step_ = step;
}

gl::VolumePass& VolumeRasterizer::pass() {
  if (!pass_) throw std::runtime_error("no pass: call start_pass() first");
  return *pass_;
}

double VolumeRasterizer::draw(const RayOptions& options, const gl::VolumeOptions& volumes) {
  gl::VolumePass& pass = this->pass();
  if (!textures_ || !occluders_) throw std::runtime_error("no view or no occluders to draw");
  gl::GBuffer g_buffer = textures_->g_buffer();
  g_buffer.step = step_;
  const gl::OcclusionTarget target = textures_->targets(false).occlusion;
  gl::OcclusionTarget drawn = target;
  gl::Texture samples;
  if (step_ > 1) {
    samples = gl::make_texture(GL_TEXTURE_2D);
    glTextureStorage2D(samples.name(), 1, GL_R32F, g_buffer.picture_width(), g_buffer.picture_height());
    drawn.texture = samples.name();
  }
  return seconds_of([&] {
    pass.draw(*occluders_, g_buffer, camera_, from_exact_receivers(options), drawn, volumes);
    if (step_ > 1) filter_->upsample(g_buffer, camera_, drawn, target, {.radius = step_});
  });
}

std::vector<float> VolumeRasterizer::read_occlusion() const { return textures_.value().read_occlusion(); }

}  // namespace lkao::raster
