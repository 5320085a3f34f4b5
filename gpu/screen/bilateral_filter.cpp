#include "lkao/gl/bilateral_filter.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <iterator>
#include <numbers>
#include <stdexcept>

#include "gpu/frame/g_buffer.h"
#include "gpu/frame/grown_size.h"
#include "gpu/frame/occlusion_target.h"
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

constexpr GLenum kFilterTargets[] = {GL_TEXTURE_2D, GL_TEXTURE_2D, GL_TEXTURE_2D, GL_TEXTURE_2D, GL_TEXTURE_2D};
static_assert(std::size(kFilterTargets) == LKAO_FILTER_UNIT_COUNT);
constexpr StateUse kUse{
    .texture_targets = kFilterTargets, .image_count = LKAO_FRAME_IMAGE_COUNT, .block_count = LKAO_BLOCK_COUNT};

void check(const BilateralFilterOptions& options) {
  lut::require(options.radius >= 1 && options.radius <= 16, "radius", "from 1 to 16", options.radius);
  lut::require(options.depth_tolerance > 0, "depth_tolerance", "above 0", options.depth_tolerance);
  lut::require(options.normal_sharpness >= 0, "normal_sharpness", "at least 0", options.normal_sharpness);
}

FilterBlock make_block(const BilateralFilterOptions& options) {
  FilterBlock block{};
  block.radius = options.radius;
  block.gauss = std::numbers::ln10_v<float> / static_cast<float>(options.radius * options.radius);
  block.depth_tolerance = options.depth_tolerance;
  block.normal_sharpness = options.normal_sharpness;
  return block;
}

void set_source(const OcclusionTarget& source, FilterBlock& block) {
  const Part first = source.part.value_or(Part{});
  block.source_x = first.x;
  block.source_y = first.y;
  block.source_channel = static_cast<int>(source.channel);
  block.source_is_visibility = source.quantity == Quantity::visibility;
}

}  // namespace

struct BilateralFilter::State {
  explicit State(const BilateralFilterSetup& wanted) : setup(wanted) {}

  // For the result of the first direction.
  void make_room(int width, int height);
  // The program in use over all pixels of the view block.
  void run(const ViewBlock& seen, FilterBlock values, const OcclusionTarget& from, const OcclusionTarget& to) const;

  BilateralFilterSetup setup;
  ProgramObject one_direction = make_program({"screen/bilateral.comp"});
  ProgramObject upsample = make_program({"screen/upsample.comp"});
  UniformBuffer<ViewBlock> view;
  UniformBuffer<FilterBlock> block;
  UniformBuffer<TargetBlock> target;
  Sampler plain_sampler = make_plain_sampler();
  Texture half_filtered;
  int room_width = 0, room_height = 0;
};

void BilateralFilter::State::make_room(int width, int height) {
  if (width <= room_width && height <= room_height) return;
  const Size size = grown_size({width, height}, {room_width, room_height});
  half_filtered = make_texture(GL_TEXTURE_2D);
  room_width = room_height = 0;
  glTextureStorage2D(half_filtered.name(), 1, GL_R32F, size.width, size.height);
  check_errors("making room for a filter");
  room_width = size.width;
  room_height = size.height;
}

void BilateralFilter::State::run(const ViewBlock& seen, FilterBlock values, const OcclusionTarget& from,
                                 const OcclusionTarget& to) const {
  set_source(from, values);
  view.set_and_bind(seen);
  block.set_and_bind(values);
  bind(to, target, plain_sampler);
  glBindTextureUnit(LKAO_UNIT_UNFILTERED, from.texture);
  glBindSampler(LKAO_UNIT_UNFILTERED, plain_sampler.name());
  begin_writing_targets();
  dispatch_over_pixels(seen.width, seen.height);
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

void BilateralFilter::filter(const GBuffer& g_buffer, const Camera& camera, const OcclusionTarget& from,
                             const OcclusionTarget& to, const BilateralFilterOptions& options) {
  State& state = *state_;
  require_clean_context(state.setup.host_errors);
  check(options);
  validate(g_buffer);
  const int width = g_buffer.picture_width(), height = g_buffer.picture_height();
  validate_source(from, width, height);
  validate(to, width, height);
  const ViewBlock seen = make_view_block(g_buffer, camera);
  const StateKeeper keeper(kUse, state.setup.keep_state);
  state.make_room(width, height);
  const OcclusionTarget between{.texture = state.half_filtered.name(), .part = Part{}};
  FilterBlock values = make_block(options);
  bind(g_buffer, state.plain_sampler);
  glUseProgram(state.one_direction.name());
  values.step_x = 1;
  state.run(seen, values, from, between);
  values.step_x = 0;
  values.step_y = 1;
  state.run(seen, values, between, to);
  check_errors("filtering occlusion");
}

void BilateralFilter::upsample(const GBuffer& g_buffer, const Camera& camera, const OcclusionTarget& from,
                               const OcclusionTarget& to, const BilateralFilterOptions& options) {
  State& state = *state_;
  require_clean_context(state.setup.host_errors);
  check(options);
  validate(g_buffer);
  if (options.radius < g_buffer.step) {
    throw std::invalid_argument(fmt::format(
        "radius must be at least the G-buffer's step of {} where it upsamples, not {}", g_buffer.step, options.radius));
  }
  validate_source(from, g_buffer.picture_width(), g_buffer.picture_height());
  validate(to, g_buffer.width, g_buffer.height);
  GBuffer all_pixels = g_buffer;
  all_pixels.step = 1;
  const ViewBlock seen = make_view_block(all_pixels, camera);
  const StateKeeper keeper(kUse, state.setup.keep_state);
  FilterBlock values = make_block(options);
  values.sample_step = g_buffer.step;
  values.sample_width = g_buffer.picture_width();
  values.sample_height = g_buffer.picture_height();
  bind(g_buffer, state.plain_sampler);
  glUseProgram(state.upsample.name());
  state.run(seen, values, from, to);
  check_errors("upsampling occlusion");
}

std::optional<BilateralFilter> BilateralFilter::try_make(const BilateralFilterSetup& setup, Status& status) noexcept {
  std::optional<BilateralFilter> filter;
  status = status_of([&] { filter.emplace(setup); });
  return filter;
}

Status BilateralFilter::try_filter(const GBuffer& g_buffer, const Camera& camera, const OcclusionTarget& from,
                                   const OcclusionTarget& to, const BilateralFilterOptions& options) noexcept {
  return status_of([&] { filter(g_buffer, camera, from, to, options); });
}

Status BilateralFilter::try_upsample(const GBuffer& g_buffer, const Camera& camera, const OcclusionTarget& from,
                                     const OcclusionTarget& to, const BilateralFilterOptions& options) noexcept {
  return status_of([&] { upsample(g_buffer, camera, from, to, options); });
}

}  // namespace lkao::gl
