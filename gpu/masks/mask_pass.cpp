// The public face of the pass.
#include "lkao/gl/mask_pass.h"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "gpu/frame/g_buffer.h"
#include "gpu/frame/occlusion_target.h"
#include "gpu/frame/texture_checks.h"
#include "gpu/gl/error.h"
#include "gpu/gl/status_of.h"
#include "gpu/masks/mask_pass_state.h"
#include "lut/ray_options.h"

namespace lkao::gl {
namespace {

void validate(const ResolveTargets& written, int width, int height) {
  if (written.occlusion.texture != 0) gl::validate(written.occlusion, width, height);
  if (written.bent_normals != 0) {
    require_size("bent_normals", written.bent_normals, {width, height, written.occlusion.part});
    require_format("bent_normals", written.bent_normals, "GL_RGBA16F and GL_RGBA32F", {GL_RGBA16F, GL_RGBA32F});
  }
}

}  // namespace

MaskPass::MaskPass(const MaskPassSetup& setup) {
  require_clean_context(setup.host_errors);
  const StateKeeper keeper(kDrawUse, setup.keep_state);
  state_ = std::make_unique<State>(setup);
  check_errors("making a MaskPass");
}

MaskPass::~MaskPass() = default;
MaskPass::MaskPass(MaskPass&&) noexcept = default;
MaskPass& MaskPass::operator=(MaskPass&&) noexcept = default;

void MaskPass::set_table(const PlaneMaskTable& table) {
  require_clean_context(state_->setup.host_errors);
  state_->set_table(table);
}

void MaskPass::draw(const Occluders& occluders, const GBuffer& g_buffer, const Camera& camera,
                    const RayOptions& options, const RasterOptions& raster) {
  require_clean_context(state_->setup.host_errors);
  lut::check(options);
  lut::require(raster.billboard_threshold >= 0, "billboard_threshold", "at least 0", raster.billboard_threshold);
  gl::validate(g_buffer);
  State& state = *state_;
  if (!state.table) throw std::runtime_error("draw() needs a plane mask table: call set_table() first");
  lut::check(options, state.table->table());
  const MeshBuffers& mesh = occluders.buffers();
  const StateKeeper keeper(kDrawUse, state.setup.keep_state);
  state.is_drawn = false;
  state.make_images(g_buffer.picture_width(), g_buffer.picture_height());
  state.wait_for_last_frame();
  if (mesh.has_ranges() || options.min_distance > 0) state.table->add_directions();
  state.describe(mesh, g_buffer, camera, options, raster);
  state.bind_inputs(g_buffer);
  state.check_inputs(g_buffer, options);
  state.classify_occluders(mesh);
  state.find_receivers();
  state.find_radius(mesh);
  state.draw_depths();
  state.draw_shapes(mesh, camera);
  state.drop_rays_not_cast();
  check_errors("drawing occlusion masks");
  state.is_drawn = true;
}

void MaskPass::resolve(const ResolveTargets& written) {
  require_clean_context(state_->setup.host_errors);
  state_->require_drawn();
  validate(written, state_->images.width(), state_->images.height());
  const StateKeeper keeper(kResolveUse, state_->setup.keep_state);
  state_->write_targets(written);
  check_errors("resolving occlusion");
}

std::optional<MaskPass> MaskPass::try_make(const MaskPassSetup& setup, Status& status) noexcept {
  std::optional<MaskPass> pass;
  status = status_of([&] { pass.emplace(setup); });
  return pass;
}

Status MaskPass::try_set_table(const PlaneMaskTable& table) noexcept {
  return status_of([&] { set_table(table); });
}

Status MaskPass::try_draw(const Occluders& occluders, const GBuffer& g_buffer, const Camera& camera,
                          const RayOptions& options, const RasterOptions& raster) noexcept {
  return status_of([&] { draw(occluders, g_buffer, camera, options, raster); });
}

Status MaskPass::try_resolve(const ResolveTargets& targets) noexcept {
  return status_of([&] { resolve(targets); });
}

ObjectName MaskPass::masks_texture() const {
  state_->require_drawn();
  return state_->images.masks();
}

std::vector<std::string> MaskPass::warnings() const {
  state_->require_drawn();
  return state_->warnings;
}

GeometryBackEnd MaskPass::geometry() const { return state_->setup.geometry; }
Accumulator MaskPass::accumulator() const { return state_->setup.accumulator; }

}  // namespace lkao::gl
