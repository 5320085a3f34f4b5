// Based on: J. Jimenez, X.-C. Wu, A. Pesce, A. Jarabo, "Practical Realtime Strategies for Accurate Indirect Occlusion",
// SIGGRAPH 2016 Courses, Technical Memo ATVI-TR-16-01; O. Therrien, Y. Levesque, G. Gilet, "Screen Space Indirect
// Lighting with Visibility Bitmask", 2023, arXiv:2301.11376.
#include "lkao/gl/horizon_pass.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "gpu/frame/g_buffer.h"
#include "gpu/frame/limits.h"
#include "gpu/frame/occlusion_target.h"
#include "gpu/frame/view.h"
#include "gpu/gl/error.h"
#include "gpu/gl/program.h"
#include "gpu/gl/state_keeper.h"
#include "gpu/gl/status_of.h"
#include "gpu/gl/uniform_buffer.h"
#include "gpu/screen/horizon/horizon_block.h"
#include "gpu/screen/picture.h"
#include "lut/require.h"

namespace lkao::gl {
namespace {

constexpr double kLargest = LKAO_LARGEST_COORDINATE;
constexpr int kMaxSliceCount = 512;
// llvmpipe ends all loops of a shader together after 65,535 rounds; two sides of each slice are walked.
constexpr int kMaxStepCount = 16384;
// Pixels: more than any picture has.
constexpr float kLongestWalk = 65536;

void check(const HorizonOptions& options) {
  lut::require(options.radius > 0 && options.radius <= kLargest, "radius", "above 0, at most 1e18", options.radius);
  lut::require(options.screen_radius > 0, "screen_radius", "above 0", options.screen_radius);
  lut::require(options.slice_count >= 1 && options.slice_count <= kMaxSliceCount, "slice_count", "from 1 to 512",
               options.slice_count);
  lut::require(options.step_count >= 1 && options.step_count <= kMaxStepCount, "step_count", "from 1 to 16384",
               options.step_count);
  if (options.slice_count * options.step_count > kMaxStepCount) {
    throw std::invalid_argument(fmt::format("slice_count x step_count must be at most {}, not {} x {}", kMaxStepCount,
                                            options.slice_count, options.step_count));
  }
  lut::require(options.step_exponent >= 1 && options.step_exponent <= 4, "step_exponent", "from 1 to 4",
               options.step_exponent);
  lut::require(options.thickness > 0, "thickness", "above 0", options.thickness);
  lut::require(options.falloff_begin >= 0 && options.falloff_begin <= 1, "falloff_begin", "from 0 to 1",
               options.falloff_begin);
  lut::require(options.angle_bias >= 0 && options.angle_bias <= 1, "angle_bias", "from 0 to 1", options.angle_bias);
}

HorizonBlock make_block(const HorizonOptions& options) {
  HorizonBlock block{};
  block.radius = options.radius;
  block.screen_radius = std::min(options.screen_radius, kLongestWalk);
  block.slice_count = options.slice_count;
  block.step_count = options.step_count;
  block.step_exponent = options.step_exponent;
  // Quotients by it are numbers then.
  block.thickness = std::min(options.thickness, std::numeric_limits<float>::max());
  block.falloff_begin = options.falloff_begin;
  block.angle_bias = options.angle_bias;
  block.has_even_slices = options.slice_density == SliceDensity::even;
  block.has_equal_angles =
      options.estimator == HorizonEstimator::bitmask && options.sector_measure == SectorMeasure::angle;
  block.seed = options.seed;
  return block;
}

}  // namespace

struct HorizonPass::State {
  explicit State(const HorizonPassSetup& wanted) : setup(wanted) {}

  const ProgramObject& program(HorizonEstimator estimator) const {
    return estimator == HorizonEstimator::bitmask ? bitmask : horizons;
  }

  HorizonPassSetup setup;
  Picture picture;
  UniformBuffer<HorizonBlock> block;
  ProgramObject horizons = make_program({"screen/horizon/horizon.comp"}, {{"LKAO_BITMASK", 0}});
  ProgramObject bitmask = make_program({"screen/horizon/horizon.comp"}, {{"LKAO_BITMASK", 1}});
};

HorizonPass::HorizonPass(const HorizonPassSetup& setup) {
  require_clean_context(setup.host_errors);
  state_ = std::make_unique<State>(setup);
  check_errors("making a HorizonPass");
}

HorizonPass::~HorizonPass() = default;
HorizonPass::HorizonPass(HorizonPass&&) noexcept = default;
HorizonPass& HorizonPass::operator=(HorizonPass&&) noexcept = default;

void HorizonPass::draw(const GBuffer& g_buffer, const Camera& camera, const HorizonOptions& options,
                       const OcclusionTarget& to) {
  State& state = *state_;
  require_clean_context(state.setup.host_errors);
  check(options);
  validate(g_buffer);
  validate(to, g_buffer.picture_width(), g_buffer.picture_height());
  const ViewBlock view = make_view_block(g_buffer, camera);
  const StateKeeper keeper(kPictureUse, state.setup.keep_state);
  state.picture.find_receivers(g_buffer, view);
  state.block.set_and_bind(make_block(options));
  state.picture.write(state.program(options.estimator), to);
  check_errors("finding occlusion by horizons");
}

std::optional<HorizonPass> HorizonPass::try_make(const HorizonPassSetup& setup, Status& status) noexcept {
  std::optional<HorizonPass> pass;
  status = status_of([&] { pass.emplace(setup); });
  return pass;
}

Status HorizonPass::try_draw(const GBuffer& g_buffer, const Camera& camera, const HorizonOptions& options,
                             const OcclusionTarget& to) noexcept {
  return status_of([&] { draw(g_buffer, camera, options, to); });
}

}  // namespace lkao::gl
