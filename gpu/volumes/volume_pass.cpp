// The public face of the pass.
#include "lkao/gl/volume_pass.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "gpu/frame/g_buffer.h"
#include "gpu/frame/occlusion_target.h"
#include "gpu/gl/error.h"
#include "gpu/gl/status_of.h"
#include "gpu/volumes/volume_pass_state.h"
#include "lut/ray_options.h"

namespace lkao::gl {
namespace {

void check_volumes(const MeshBuffers& mesh, const RayOptions& options, const VolumeOptions& volumes) {
  lut::check(options);
  lut::require(std::isfinite(options.radius), "radius", "finite for volumes", options.radius);
  lut::require(options.min_distance == 0, "min_distance", "0 for volumes", options.min_distance);
  for (int i = 0; i < 3; ++i) {
    lut::require(std::isfinite(volumes.compensation[i]), "compensation", "finite", volumes.compensation[i]);
  }
  if (mesh.has_ranges()) throw std::invalid_argument("occluders of a VolumePass must have no ranges");
}

}  // namespace

VolumePass::VolumePass(const VolumePassSetup& setup) {
  require_clean_context(setup.host_errors);
  const StateKeeper keeper(kVolumesUse, setup.keep_state);
  state_ = std::make_unique<State>(setup);
  check_errors("making a VolumePass");
}

VolumePass::~VolumePass() = default;
VolumePass::VolumePass(VolumePass&&) noexcept = default;
VolumePass& VolumePass::operator=(VolumePass&&) noexcept = default;

void VolumePass::draw(const Occluders& occluders, const GBuffer& g_buffer, const Camera& camera,
                      const RayOptions& options, const OcclusionTarget& to, const VolumeOptions& volumes) {
  State& state = *state_;
  require_clean_context(state.setup.host_errors);
  const MeshBuffers& mesh = occluders.buffers();
  check_volumes(mesh, options, volumes);
  validate(g_buffer);
  validate(to, g_buffer.picture_width(), g_buffer.picture_height());
  const StateKeeper keeper(kVolumesUse, state.setup.keep_state);
  state.is_drawn = false;
  state.make_images(g_buffer);
  state.wait_for_last_frame();
  state.describe(mesh, g_buffer, camera, options, volumes);
  state.bind_inputs(g_buffer);
  state.check_inputs(g_buffer, options);
  state.find_volumes(mesh);
  state.draw_receivers();
  state.draw_volumes(mesh, camera);
  state.resolve(to);
  check_errors("drawing ambient occlusion volumes");
  state.is_drawn = true;
}

void VolumePass::forget_volumes() { state_->kept.forget(); }

VolumeFragments VolumePass::read_fragment_counts() {
  require_clean_context(state_->setup.host_errors);
  if (!state_->is_drawn) throw std::runtime_error("nothing to read: no draw() came before");
  if (!state_->setup.count_fragments) return {};
  const auto [drawn, inside, blended] = state_->counters.read();
  return {drawn, inside, blended};
}

std::vector<std::string> VolumePass::warnings() const { return state_->warnings; }

std::optional<VolumePass> VolumePass::try_make(const VolumePassSetup& setup, Status& status) noexcept {
  std::optional<VolumePass> pass;
  status = status_of([&] { pass.emplace(setup); });
  return pass;
}

Status VolumePass::try_draw(const Occluders& occluders, const GBuffer& g_buffer, const Camera& camera,
                            const RayOptions& options, const OcclusionTarget& to,
                            const VolumeOptions& volumes) noexcept {
  return status_of([&] { draw(occluders, g_buffer, camera, options, to, volumes); });
}

GeometryBackEnd VolumePass::geometry() const { return state_->setup.geometry; }

}  // namespace lkao::gl
