// The public face of the pass.
#include <cmath>
#include <stdexcept>
#include <utility>

#include "gpu/g_buffer.h"
#include "gpu/gl_error.h"
#include "gpu/pass_state.h"
#include "gpu/state_keeper.h"
#include "lut/ray_options.h"

namespace lkao::gl {

OcclusionPass::OcclusionPass(const PassSetup& setup) {
  require_clean_context();
  const StateKeeper keeper;
  state_ = std::make_unique<State>(setup);
  check_errors("making an OcclusionPass");
}

OcclusionPass::~OcclusionPass() = default;
OcclusionPass::OcclusionPass(OcclusionPass&&) noexcept = default;
OcclusionPass& OcclusionPass::operator=(OcclusionPass&&) noexcept = default;

void OcclusionPass::set_occluders(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                                  std::span<const glm::vec2> ranges) {
  require_clean_context();
  state_->occluders.set(positions, triangles, ranges);
}

void OcclusionPass::update_positions(std::span<const glm::vec3> positions) {
  require_clean_context();
  state_->occluders.update(positions);
}

ObjectName OcclusionPass::positions_buffer() const { return state_->occluders.positions_buffer(); }

void OcclusionPass::set_table(const PlaneMaskTable& table) {
  require_clean_context();
  const StateKeeper keeper;
  TableBuffer buffer(table);
  const PassSetup& setup = state_->setup;
  const Defines defines = {{"LKAO_LAYERS", buffer.layer_count()},
                           {"LKAO_MUST_MAY", buffer.has_bounds()},
                           {"LKAO_CUBE_ADDRESSING", buffer.is_cube()},
                           {"LKAO_DOUBLE", setup.precision == Precision::double_precision},
                           {"LKAO_ATOMICS", setup.accumulator == Accumulator::ssbo},
                           {"LKAO_COUNT", setup.count_fragments}};
  state_->shapes = make_shape_programs(setup.geometry, "accumulate.frag", defines);
  state_->table = std::move(buffer);
  state_->is_drawn = false;
}

void OcclusionPass::draw(const GBuffer& g_buffer, const Camera& camera, const RayOptions& options,
                         const RasterOptions& raster) {
  require_clean_context();
  lut::check(options);
  lut::require(raster.billboard_threshold >= 0, "billboard_threshold", "at least 0", raster.billboard_threshold);
  validate(g_buffer);
  if (!state_->table) throw std::runtime_error("draw() needs a plane mask table: call set_table() first");
  if (std::isinf(options.radius) && !state_->table->has_full_lengths()) {
    throw std::invalid_argument("radius must be finite, not inf, for a plane mask table of rays of several lengths");
  }
  const StateKeeper keeper;
  state_->is_drawn = false;
  const int layer_count = state_->table->layer_count();
  if (!state_->targets.fits(g_buffer.width, g_buffer.height, layer_count)) {
    // The old ones first: there may not be room for both.
    state_->targets = Targets();
    state_->targets =
        Targets(g_buffer.width, g_buffer.height, layer_count, state_->setup.accumulator == Accumulator::ssbo);
  }
  state_->wait_for_last_frame();
  if (state_->occluders.has_ranges()) state_->table->add_directions();
  state_->set_uniforms(g_buffer, camera, options, raster);
  state_->bind_uniforms();
  state_->unbounded_radius.begin();
  state_->classify_occluders();
  state_->find_receivers();
  state_->find_radius();
  state_->draw_depths();
  state_->draw_shapes(camera);
  state_->drop_rays_not_cast();
  check_errors("drawing occlusion masks");
  state_->is_drawn = true;
}

void OcclusionPass::resolve(const ResolveTargets& targets) {
  require_clean_context();
  state_->require_drawn();
  validate(targets, state_->targets.width(), state_->targets.height());
  const StateKeeper keeper;
  PassUniforms& uniforms = state_->uniforms;
  uniforms.flags.x &= ~(LKAO_FLAG_WRITE_OCCLUSION | LKAO_FLAG_WRITE_BENT_NORMALS);
  uniforms.jitter.z = targets.background;
  if (targets.occlusion != 0) {
    uniforms.flags.x |= LKAO_FLAG_WRITE_OCCLUSION;
    glBindImageTexture(0, targets.occlusion, 0, GL_FALSE, 0, GL_WRITE_ONLY, format_of(targets.occlusion));
  }
  if (targets.bent_normals != 0) {
    uniforms.flags.x |= LKAO_FLAG_WRITE_BENT_NORMALS;
    glBindImageTexture(1, targets.bent_normals, 0, GL_FALSE, 0, GL_WRITE_ONLY, format_of(targets.bent_normals));
  }
  // Whoever reads or draws to the targets comes first.
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  state_->bind_uniforms();
  state_->table->bind();
  glBindTextureUnit(LKAO_UNIT_RECEIVERS, state_->targets.receivers());
  glBindTextureUnit(LKAO_UNIT_MASKS, state_->targets.masks());
  glUseProgram(state_->resolve.name());
  state_->dispatch_over_pixels();
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT |
                  GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_PIXEL_BUFFER_BARRIER_BIT);
  check_errors("resolving occlusion");
}

ObjectName OcclusionPass::masks_texture() const {
  state_->require_drawn();
  return state_->targets.masks();
}

GeometryBackEnd OcclusionPass::geometry() const { return state_->setup.geometry; }
Accumulator OcclusionPass::accumulator() const { return state_->setup.accumulator; }

}  // namespace lkao::gl
