// Based on: M. McGuire, B. Osman, M. Bukowski, P. Hennessy, "The Alchemy Screen-Space Ambient Obscurance Algorithm",
// HPG 2011.
#include "lkao/gl/alchemy_pass.h"

#include <algorithm>
#include <cmath>

#include "gpu/frame/g_buffer.h"
#include "gpu/frame/occlusion_target.h"
#include "gpu/gl/error.h"
#include "gpu/gl/objects.h"
#include "gpu/gl/program.h"
#include "gpu/gl/state_keeper.h"
#include "gpu/gl/status_of.h"
#include "gpu/gl/uniform_buffer.h"
#include "gpu/screen/alchemy/alchemy_block.h"
#include "gpu/screen/picture.h"
#include "lut/require.h"

namespace lkao::gl {
namespace {

static_assert(static_cast<int>(DiscPattern::jittered) == LKAO_PATTERN_JITTERED &&
              static_cast<int>(DiscPattern::spiral) == LKAO_PATTERN_SPIRAL &&
              static_cast<int>(DiscPattern::even_spiral) == LKAO_PATTERN_EVEN_SPIRAL);
static_assert(static_cast<int>(ObscuranceFalloff::cut_off) == LKAO_FALLOFF_CUT_OFF &&
              static_cast<int>(ObscuranceFalloff::smooth) == LKAO_FALLOFF_SMOOTH &&
              static_cast<int>(ObscuranceFalloff::medium) == LKAO_FALLOFF_MEDIUM &&
              static_cast<int>(ObscuranceFalloff::low) == LKAO_FALLOFF_LOW);

constexpr int kMaxBandCount = 16;
constexpr int kMaxSampleCount = 16384;

void check(const AlchemyOptions& options) {
  const auto require_within = [](float value, float least, float most, const char* name, const char* expected) {
    lut::require(value >= least && value <= most, name, expected, value);
  };
  require_within(options.radius, 1e-18f, 1e18f, "radius", "from 1e-18 to 1e18");
  require_within(options.intensity, 0, 1e18f, "intensity", "from 0 to 1e18");
  require_within(options.bias, 0, 1e18f, "bias", "from 0 to 1e18");
  require_within(options.epsilon, 1e-12f, 1e12f, "epsilon", "from 1e-12 to 1e12");
  lut::require(options.contrast > 0 && std::isfinite(options.contrast), "contrast", "above 0 and finite",
               options.contrast);
  lut::require(options.max_band_count >= 1 && options.max_band_count <= kMaxBandCount, "max_band_count", "from 1 to 16",
               options.max_band_count);
  lut::require(options.samples_per_band >= 1 && options.samples_per_band <= kMaxSampleCount / options.max_band_count,
               "samples_per_band", "at least 1, and at most 16384 in all bands", options.samples_per_band);
  lut::require(options.full_radius >= 0, "full_radius", "at least 0", options.full_radius);
  lut::require(options.spiral_turns > 0 && std::isfinite(options.spiral_turns), "spiral_turns", "above 0 and finite",
               options.spiral_turns);
}

AlchemyBlock make_block(const AlchemyOptions& options, const GBuffer& g_buffer, const ViewBlock& view) {
  AlchemyBlock block{};
  block.radius = options.radius;
  block.intensity = options.intensity;
  block.bias = options.bias;
  block.parallel_distance = view.pixel_size / static_cast<float>(2 * g_buffer.step) *
                            static_cast<float>(std::max(g_buffer.width, g_buffer.height));
  block.epsilon = options.epsilon;
  block.contrast = options.contrast;
  block.falloff = static_cast<int>(options.falloff);
  block.samples_per_band = options.samples_per_band;
  block.max_band_count = options.max_band_count;
  block.full_radius = options.full_radius;
  block.pattern = static_cast<int>(options.pattern);
  block.spiral_turns = options.spiral_turns;
  block.seed = options.seed;
  return block;
}

}  // namespace

struct AlchemyPass::State {
  explicit State(const AlchemyPassSetup& wanted) : setup(wanted) {}

  AlchemyPassSetup setup;
  Picture picture;
  UniformBuffer<AlchemyBlock> block_buffer;
  ProgramObject obscurance = make_program({"screen/alchemy/obscurance.comp"});
};

AlchemyPass::AlchemyPass(const AlchemyPassSetup& setup) {
  require_clean_context(setup.host_errors);
  state_ = std::make_unique<State>(setup);
  check_errors("making an AlchemyPass");
}

AlchemyPass::~AlchemyPass() = default;
AlchemyPass::AlchemyPass(AlchemyPass&&) noexcept = default;
AlchemyPass& AlchemyPass::operator=(AlchemyPass&&) noexcept = default;

void AlchemyPass::draw(const GBuffer& g_buffer, const Camera& camera, const AlchemyOptions& options,
                       const OcclusionTarget& to) {
  State& state = *state_;
  require_clean_context(state.setup.host_errors);
  check(options);
  validate(g_buffer);
  validate(to, g_buffer.picture_width(), g_buffer.picture_height());
  const ViewBlock view = make_view_block(g_buffer, camera);
  const StateKeeper keeper(kPictureUse, state.setup.keep_state);
  state.picture.find_receivers(g_buffer, view);
  state.block_buffer.set_and_bind(make_block(options, g_buffer, view));
  state.picture.write(state.obscurance, to);
  check_errors("drawing obscurance");
}

std::optional<AlchemyPass> AlchemyPass::try_make(const AlchemyPassSetup& setup, Status& status) noexcept {
  std::optional<AlchemyPass> pass;
  status = status_of([&] { pass.emplace(setup); });
  return pass;
}

Status AlchemyPass::try_draw(const GBuffer& g_buffer, const Camera& camera, const AlchemyOptions& options,
                             const OcclusionTarget& to) noexcept {
  return status_of([&] { draw(g_buffer, camera, options, to); });
}

}  // namespace lkao::gl
