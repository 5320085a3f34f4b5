#include "raster/rasterizer.h"

#include <cmath>
#include <stdexcept>

#include "raster/camera.h"
#include "raster/timed_frame.h"

namespace lkao::raster {
namespace {

void require(bool condition, const char* missing) {
  if (!condition) throw std::runtime_error(missing);
}

}  // namespace

Rasterizer::Rasterizer(gl::Device device) : context_(std::make_unique<gl::HeadlessContext>(device)) {
  context_->make_current();
}

void Rasterizer::require_size(int width, int height) const { require_texture_size(width, height); }

void Rasterizer::set_view(const scene::Camera& camera, const scene::ReceiverImage& image) {
  drawn_ = Drawn::nothing;
  textures_.reset();  // the old ones first: there may not be room for both
  textures_.emplace(image);
  camera_ = gl_camera(camera, image.width, image.height);
}

void Rasterizer::start_pass(const gl::MaskPassSetup& setup, const scene::Mesh& mesh, const PlaneMaskTable& table,
                            std::span<const glm::vec2> ranges) {
  drawn_ = Drawn::nothing;
  pass_.reset();
  occluders_.reset();
  pass_.emplace(setup);
  occluders_.emplace(mesh.positions, mesh.triangles, ranges);
  pass_->set_table(table);
}

gl::MaskPass& Rasterizer::pass() {
  require(pass_.has_value(), "no pass: call start_pass() first");
  return *pass_;
}

void Rasterizer::warm_up(const RayOptions& options, const gl::RasterOptions& raster) {
  constexpr float kShare = 1e-4f;
  RayOptions small = options;
  small.radius = kShare * (std::isinf(options.radius) ? 1 : options.radius);
  draw(small, raster);
  drawn_ = Drawn::nothing;
}

double Rasterizer::draw(const RayOptions& options, const gl::RasterOptions& raster, bool with_bent_normals) {
  gl::MaskPass& pass = this->pass();
  require(textures_.has_value(), "no view: call set_view() first");
  drawn_ = Drawn::nothing;
  const gl::GBuffer g_buffer = textures_->g_buffer();
  const gl::ResolveTargets targets = textures_->targets(with_bent_normals);
  const double seconds = seconds_of([&] {
    pass.draw(*occluders_, g_buffer, camera_, from_exact_receivers(options), raster);
    pass.resolve(targets);
  });
  drawn_ = with_bent_normals ? Drawn::bent_normals_too : Drawn::occlusion;
  return seconds;
}

std::vector<float> Rasterizer::read_occlusion() const {
  require(drawn_ != Drawn::nothing, "no frame: call draw() first");
  return textures_->read_occlusion();
}

std::vector<glm::vec3> Rasterizer::read_bent_normals() const {
  require(drawn_ == Drawn::bent_normals_too, "no bent normals: call draw() with them first");
  return textures_->read_bent_normals();
}

}  // namespace lkao::raster
