#include "lkao/gl/bilateral_filter.h"

#include <epoxy/gl.h>

#include <iterator>
#include <numbers>

#include "gpu/frame/g_buffer.h"
#include "gpu/frame/occlusion_target.h"
#include "gpu/frame/texture_checks.h"
#include "gpu/frame/view.h"
#include "gpu/gl/error.h"
#include "gpu/gl/objects.h"
#include "gpu/gl/program.h"
#include "gpu/gl/state_keeper.h"
#include "gpu/gl/status_of.h"
#include "gpu/gl/uniform_buffer.h"
#include "gpu/screen/filter_block.h"
#include "gpu/screen/units.h"
#include "lut/ray_options.h"

namespace lkao::gl {
namespace {

constexpr GLenum kTextureTargets[] = {GL_TEXTURE_2D, GL_TEXTURE_2D, GL_TEXTURE_2D, GL_TEXTURE_2D};
static_assert(std::size(kTextureTargets) == LKAO_FILTER_UNIT_COUNT);
constexpr StateUse kUse{.texture_targets = kTextureTargets, .image_count = 1, .block_count = LKAO_BLOCK_COUNT};

void check(const BilateralFilterOptions& options) {
  lut::require(options.radius >= 1 && options.radius <= 16, "radius", "from 1 to 16", options.radius);
  lut::require(options.depth_tolerance > 0, "depth_tolerance", "above 0", options.depth_tolerance);
  lut::require(options.normal_sharpness >= 0, "normal_sharpness", "at least 0", options.normal_sharpness);
}

FilterBlock make_block(const BilateralFilterOptions& options, float background) {
  FilterBlock block{};
  block.radius = options.radius;
  block.gauss = std::numbers::ln10_v<float> / static_cast<float>(options.radius * options.radius);
  block.depth_tolerance = options.depth_tolerance;
  block.normal_sharpness = options.normal_sharpness;
  block.background = background;
  return block;
}

}  // namespace

struct BilateralFilter::State {
  explicit State(const BilateralFilterSetup& wanted) : setup(wanted) {}

  void make_room(int wanted_width, int wanted_height);
  // Along rows (1, 0) or columns (0, 1).
  void run(int step_x, int step_y, FilterBlock block, ObjectName from, ObjectName to) const;

  BilateralFilterSetup setup;
  ProgramObject program = make_program({"screen/bilateral.comp"});
  UniformBuffer<ViewBlock> view;
  UniformBuffer<FilterBlock> block;
  Sampler plain_sampler = make_plain_sampler();
  Texture half_filtered;
  int width = 0, height = 0;
};

void BilateralFilter::State::make_room(int wanted_width, int wanted_height) {
  if (wanted_width == width && wanted_height == height) return;
  half_filtered = make_texture(GL_TEXTURE_2D);
  width = height = 0;
  glTextureStorage2D(half_filtered.name(), 1, GL_R32F, wanted_width, wanted_height);
  check_errors("making room for a filter");
  width = wanted_width;
  height = wanted_height;
}

void BilateralFilter::State::run(int step_x, int step_y, FilterBlock values, ObjectName from, ObjectName to) const {
  values.step_x = step_x;
  values.step_y = step_y;
  block.set_and_bind(values);
  glBindTextureUnit(LKAO_UNIT_UNFILTERED, from);
  glBindSampler(LKAO_UNIT_UNFILTERED, plain_sampler.name());
  bind_image(0, to);
  begin_writing_targets();
  dispatch_over_pixels(width, height);
  end_writing_targets();
}

BilateralFilter::BilateralFilter(const BilateralFilterSetup& setup) {
  require_clean_context(setup.host_errors);
  state_ = std::make_unique<State>(setup);
  check_errors("making a BilateralFilter");
}

BilateralFilter::~BilateralFilter() = default;
BilateralFilter::BilateralFilter(BilateralFilter&&) noexcept = default;
BilateralFilter& BilateralFilter::operator=(BilateralFilter&&) noexcept = default;

void BilateralFilter::filter(const GBuffer& g_buffer, const Camera& camera, ObjectName occlusion,
                             const OcclusionTarget& to, const BilateralFilterOptions& options) {
  require_clean_context(state_->setup.host_errors);
  check(options);
  validate(g_buffer);
  require_readable("occlusion", occlusion, g_buffer.width, g_buffer.height, 1, Use::value);
  validate(to, g_buffer.width, g_buffer.height);
  const ViewBlock view = make_view_block(g_buffer, camera);
  const StateKeeper keeper(kUse, state_->setup.keep_state);
  state_->make_room(g_buffer.width, g_buffer.height);
  state_->view.set_and_bind(view);
  bind(g_buffer, state_->plain_sampler);
  glUseProgram(state_->program.name());
  const FilterBlock block = make_block(options, to.background);
  state_->run(1, 0, block, occlusion, state_->half_filtered.name());
  state_->run(0, 1, block, state_->half_filtered.name(), to.texture);
  check_errors("filtering occlusion");
}

std::optional<BilateralFilter> BilateralFilter::try_make(const BilateralFilterSetup& setup, Status& status) noexcept {
  std::optional<BilateralFilter> filter;
  status = status_of([&] { filter.emplace(setup); });
  return filter;
}

Status BilateralFilter::try_filter(const GBuffer& g_buffer, const Camera& camera, ObjectName occlusion,
                                   const OcclusionTarget& to, const BilateralFilterOptions& options) noexcept {
  return status_of([&] { filter(g_buffer, camera, occlusion, to, options); });
}

}  // namespace lkao::gl
