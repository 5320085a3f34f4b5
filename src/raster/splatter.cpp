#include "raster/splatter.h"

#include <stdexcept>

#include "raster/camera.h"
#include "raster/timed_frame.h"

namespace lkao::raster {
namespace {

void require_view(bool has_view) {
  if (!has_view) throw std::runtime_error("no view: call set_view() first");
}

}  // namespace

Splatter::Splatter(gl::Device device) : context_(std::make_unique<gl::HeadlessContext>(device)) {
  context_->make_current();
  pass_.emplace(gl::SplatPassSetup{.count_fragments = true});
}

void Splatter::set_view(const scene::Camera& camera, const scene::ReceiverImage& image,
                        const std::optional<scene::ReceiverImage>& behind) {
  textures_.reset();  // the old ones first: there may not be room for both
  behind_.reset();
  textures_.emplace(image);
  if (behind) behind_.emplace(*behind);
  camera_ = gl_camera(camera, image.width, image.height);
}

double Splatter::draw(const gl::SplatOptions& options) {
  require_view(textures_.has_value());
  const gl::GBuffer g_buffer = textures_->g_buffer(), second = behind_ ? behind_->g_buffer() : gl::GBuffer{};
  const gl::OcclusionTarget target = textures_->targets(false).occlusion;
  return seconds_of([&] { pass_->draw(g_buffer, camera_, options, target, behind_ ? &second : nullptr); });
}

std::vector<float> Splatter::read_occlusion() const {
  require_view(textures_.has_value());
  return textures_->read_occlusion();
}

}  // namespace lkao::raster
