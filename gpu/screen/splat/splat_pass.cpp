// Based on: P. Shanmugam, O. Arikan, "Hardware Accelerated Ambient Occlusion Techniques on GPUs", I3D 2007.
#include "lkao/gl/splat_pass.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <stdexcept>

#include "gpu/frame/g_buffer.h"
#include "gpu/frame/limits.h"
#include "gpu/frame/occlusion_target.h"
#include "gpu/frame/view.h"
#include "gpu/gl/error.h"
#include "gpu/gl/objects.h"
#include "gpu/gl/program.h"
#include "gpu/gl/state_keeper.h"
#include "gpu/gl/status_of.h"
#include "gpu/gl/uniform_buffer.h"
#include "gpu/screen/splat/sphere_buffer.h"
#include "gpu/screen/splat/splat_block.h"
#include "gpu/screen/splat/splat_images.h"
#include "gpu/screen/splat/units.h"
#include "lut/require.h"

namespace lkao::gl {
namespace {

constexpr GLenum kTargets[] = {GL_TEXTURE_2D,       GL_TEXTURE_2D,       GL_TEXTURE_2D,     GL_TEXTURE_2D,
                               GL_TEXTURE_2D_ARRAY, GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BUFFER, GL_TEXTURE_2D};
static_assert(std::size(kTargets) == LKAO_SPLAT_UNIT_COUNT);
constexpr StateUse kSplatUse{
    .texture_targets = kTargets, .image_count = 2, .block_count = LKAO_BLOCK_COUNT, .draws = true, .blends = true};

constexpr double kLargestRadius = LKAO_LARGEST_COORDINATE;

void check(const SplatOptions& options) {
  if (options.near_half) {
    const float share = options.pixel_sphere_radius;
    lut::require(options.near_radius > 0 && options.near_radius <= kLargestRadius, "near_radius",
                 "above 0, at most 1e18", options.near_radius);
    lut::require(options.samples_per_pixel >= 0, "samples_per_pixel", "at least 0", options.samples_per_pixel);
    lut::require(options.max_sample_count >= 1 && options.max_sample_count <= 16384, "max_sample_count",
                 "from 1 to 16384", options.max_sample_count);
    lut::require(share > 0 && share <= 16, "pixel_sphere_radius", "above 0, at most 16", share);
  }
  if (options.far_half) {
    lut::require(options.epsilon > 0 && options.epsilon <= 1, "epsilon", "above 0, at most 1", options.epsilon);
    lut::require(options.far_radius > 0, "far_radius", "above 0", options.far_radius);
  }
}

void validate_behind(const GBuffer& behind, const GBuffer& g_buffer) {
  if (behind.width != g_buffer.width || behind.height != g_buffer.height || behind.step != g_buffer.step) {
    throw std::invalid_argument(
        fmt::format("behind must be of {}x{} pixels and the step {}, as the G-buffer is, not of {}x{} and {}",
                    g_buffer.width, g_buffer.height, g_buffer.step, behind.width, behind.height, behind.step));
  }
  validate(behind);
}

SplatBlock make_block(const SplatOptions& options, int layer_count) {
  const bool has_both = options.near_half && options.far_half;
  SplatBlock block{};
  block.layer_count = options.near_half ? layer_count : 0;
  block.pixel_sphere_radius = options.pixel_sphere_radius;
  block.near_radius = options.near_radius;
  block.samples_per_pixel = options.samples_per_pixel;
  block.max_sample_count = options.max_sample_count;
  block.has_falling_density = options.density == SampleDensity::falling;
  block.seed = options.seed;
  block.is_exact = options.formula == SphereFormula::exact;
  block.scale = options.formula == SphereFormula::printed ? std::numbers::pi_v<float> : 1.0f;
  block.reach = options.far_half ? sphere_reach(options.epsilon, options.formula) : 0.0f;
  block.far_begin = has_both ? options.near_radius : 0.0f;
  // Beyond all that is usable; squares and sums of it are no concern of shaders.
  block.far_end = std::min(options.far_radius, static_cast<float>(4 * kLargestRadius));
  block.fade_begin = options.inside == InsideSphere::faded ? 2.0f : 0.0f;
  block.blocks_inside = options.inside == InsideSphere::everything;
  return block;
}

}  // namespace

float sphere_reach(float epsilon, SphereFormula formula) {
  lut::require(epsilon > 0 && epsilon <= 1, "epsilon", "above 0, at most 1", epsilon);
  const double e = formula == SphereFormula::printed ? epsilon / std::numbers::pi : double{epsilon};
  if (formula == SphereFormula::exact) return static_cast<float>(1 / std::sqrt(e));
  // Eq. 5, over pi: 1 / sin(acos(1 - e / 2)), written so that small numbers keep their digits.
  return static_cast<float>(1 / std::sqrt(e * (1 - e / 4)));
}

struct SplatPass::State {
  explicit State(const SplatPassSetup& wanted) : setup(wanted), spheres(wanted.count_fragments) {}

  // The steps of a frame, in their order.
  void find_surfaces(const GBuffer& g_buffer, const ViewBlock& view, int layer, SplatBlock block) const;
  void bind_images() const;
  void add_near_half() const;
  void add_far_half(bool is_wanted);
  void write_target(const OcclusionTarget& to) const;

  SplatPassSetup setup;
  SphereBuffer spheres;
  SplatImages images;
  UniformBuffer<ViewBlock> view_buffer;
  UniformBuffer<SplatBlock> block_buffer;
  UniformBuffer<TargetBlock> target_buffer;
  Sampler plain_sampler = make_plain_sampler();
  VertexArray no_attributes = make_vertex_array();
  ProgramObject surfaces = make_program({"screen/splat/surfaces.comp"});
  ProgramObject near_half = make_program({"screen/splat/near.comp"});
  ProgramObject far_half = make_program({"screen/splat/far.vert", "screen/splat/far.frag"});
  ProgramObject resolve = make_program({"screen/splat/resolve.comp"});
};

void SplatPass::State::find_surfaces(const GBuffer& g_buffer, const ViewBlock& view, int layer,
                                     SplatBlock block) const {
  block.layer = layer;
  view_buffer.set_and_bind(view);
  block_buffer.set_and_bind(block);
  bind(g_buffer, plain_sampler);
  glUseProgram(surfaces.name());
  glBindImageTexture(0, images.receivers().name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA32F);
  glBindImageTexture(1, images.pixel_spheres().name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA32F);
  dispatch_over_pixels(images.width(), images.height());
}

void SplatPass::State::bind_images() const {
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  glBindTextureUnit(LKAO_UNIT_SCREEN_RECEIVERS, images.receivers().name());
  glBindTextureUnit(LKAO_UNIT_SPLAT_PIXEL_SPHERES, images.pixel_spheres().name());
  for (int unit : {LKAO_UNIT_SCREEN_RECEIVERS, LKAO_UNIT_SPLAT_PIXEL_SPHERES, LKAO_UNIT_SPLAT_SUM}) {
    glBindSampler(static_cast<GLuint>(unit), plain_sampler.name());
  }
}

// Without layers of the scene, that is where the near half is off, it writes nothing but zeros.
void SplatPass::State::add_near_half() const {
  glUseProgram(near_half.name());
  glBindImageTexture(0, images.sum().name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
  dispatch_over_pixels(images.width(), images.height());
  glMemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT);
}

void SplatPass::State::add_far_half(bool is_wanted) {
  glUseProgram(far_half.name());
  glBindVertexArray(no_attributes.name());
  glBindFramebuffer(GL_FRAMEBUFFER, images.sum_framebuffer().name());
  glViewportIndexedf(0, 0, 0, static_cast<float>(images.width()), static_cast<float>(images.height()));
  glEnablei(GL_BLEND, 0);
  glBlendFunci(0, GL_ONE, GL_ONE);
  glBlendEquationi(0, GL_FUNC_ADD);
  spheres.draw(is_wanted);
}

void SplatPass::State::write_target(const OcclusionTarget& to) const {
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  glBindTextureUnit(LKAO_UNIT_SPLAT_SUM, images.sum().name());
  glUseProgram(resolve.name());
  bind(to, target_buffer, plain_sampler);
  begin_writing_targets();
  dispatch_over_pixels(images.width(), images.height());
  end_writing_targets();
}

SplatPass::SplatPass(const SplatPassSetup& setup) {
  require_clean_context(setup.host_errors);
  state_ = std::make_unique<State>(setup);
  check_errors("making a SplatPass");
}

SplatPass::~SplatPass() = default;
SplatPass::SplatPass(SplatPass&&) noexcept = default;
SplatPass& SplatPass::operator=(SplatPass&&) noexcept = default;

void SplatPass::set_spheres(std::span<const glm::vec4> spheres) {
  require_clean_context(state_->setup.host_errors);
  state_->spheres.set(spheres);
}

ObjectName SplatPass::spheres_buffer() const { return state_->spheres.name(); }

void SplatPass::draw(const GBuffer& g_buffer, const Camera& camera, const SplatOptions& options,
                     const OcclusionTarget& to, const GBuffer* behind) {
  State& state = *state_;
  require_clean_context(state.setup.host_errors);
  check(options);
  validate(g_buffer);
  if (behind != nullptr) validate_behind(*behind, g_buffer);
  validate(to, g_buffer.picture_width(), g_buffer.picture_height());
  const ViewBlock view = make_view_block(g_buffer, camera);
  const int layer_count = behind != nullptr ? 2 : 1;
  const SplatBlock block = make_block(options, layer_count);
  const StateKeeper keeper(kSplatUse, state.setup.keep_state);
  state.images.make_room(g_buffer.picture_width(), g_buffer.picture_height(), layer_count);
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);  // what read the last frame's images comes first
  if (behind != nullptr) state.find_surfaces(*behind, make_view_block(*behind, camera), 1, block);
  state.find_surfaces(g_buffer, view, 0, block);
  state.bind_images();
  state.add_near_half();
  state.add_far_half(options.far_half);
  state.write_target(to);
  check_errors("splatting occlusion");
}

std::uint64_t SplatPass::read_fragment_count() const {
  require_clean_context(state_->setup.host_errors);
  return state_->spheres.read_fragment_count();
}

std::optional<SplatPass> SplatPass::try_make(const SplatPassSetup& setup, Status& status) noexcept {
  std::optional<SplatPass> pass;
  status = status_of([&] { pass.emplace(setup); });
  return pass;
}

Status SplatPass::try_set_spheres(std::span<const glm::vec4> spheres) noexcept {
  return status_of([&] { set_spheres(spheres); });
}

Status SplatPass::try_draw(const GBuffer& g_buffer, const Camera& camera, const SplatOptions& options,
                           const OcclusionTarget& to, const GBuffer* behind) noexcept {
  return status_of([&] { draw(g_buffer, camera, options, to, behind); });
}

}  // namespace lkao::gl
