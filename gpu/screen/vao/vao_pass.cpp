// Based on: J. Boksansky, A. Pospisil, J. Bittner, "VAO++: Practical Volumetric Ambient Occlusion for Games",
// EGSR 2017.
#include "lkao/gl/vao_pass.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <type_traits>

#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "gpu/frame/g_buffer.h"
#include "gpu/frame/grown_size.h"
#include "gpu/frame/limits.h"
#include "gpu/frame/occlusion_target.h"
#include "gpu/frame/texture_checks.h"
#include "gpu/frame/view.h"
#include "gpu/gl/error.h"
#include "gpu/gl/fragment_counters.h"
#include "gpu/gl/objects.h"
#include "gpu/gl/program.h"
#include "gpu/gl/state_keeper.h"
#include "gpu/gl/status_of.h"
#include "gpu/gl/uniform_buffer.h"
#include "gpu/screen/picture.h"
#include "gpu/screen/vao/sample_sets.h"
#include "gpu/screen/vao/units.h"
#include "gpu/screen/vao/vao_block.h"
#include "lut/require.h"

namespace lkao::gl {
namespace {

constexpr GLenum kVaoTargets[] = {GL_TEXTURE_2D,       GL_TEXTURE_2D, GL_TEXTURE_2D, GL_TEXTURE_2D,
                                  GL_TEXTURE_2D_ARRAY, GL_TEXTURE_2D, GL_TEXTURE_2D};
static_assert(std::size(kVaoTargets) == LKAO_VAO_UNIT_COUNT);

constexpr int kLargestSet = kSampleSetSizes.back();

bool is_set_size(int count) {
  return std::find(kSampleSetSizes.begin(), kSampleSetSizes.end(), count) != kSampleSetSizes.end();
}

void check(const LuminanceSensitivity& luminance) {
  lut::require(std::isfinite(luminance.threshold), "luminance threshold", "finite", luminance.threshold);
  lut::require(luminance.width > 0 && std::isfinite(luminance.width), "luminance width", "above 0", luminance.width);
  lut::require(luminance.sigma > 0 && std::isfinite(luminance.sigma), "luminance sigma", "above 0", luminance.sigma);
}

void check(const VaoOptions& options) {
  const int count = options.sample_count, stride = options.bleeding_stride;
  lut::require(options.radius > 0 && options.radius <= LKAO_LARGEST_COORDINATE, "radius", "above 0, at most 1e18",
               options.radius);
  lut::require(is_set_size(count) || (count > kLargestSet && count <= 65535), "sample_count",
               "2, 4, 8, 16, 32 or from 33 to 65535", count);
  lut::require(options.fewest_samples_width >= 0, "fewest_samples_width", "at least 0", options.fewest_samples_width);
  lut::require(options.thickness >= 0, "thickness", "at least 0", options.thickness);
  lut::require(stride == 1 || stride == 2 || stride == 4, "bleeding_stride", "1, 2 or 4", stride);
  if (options.luminance) check(*options.luminance);
}

void require_colours(const GBuffer& g_buffer, const VaoOptions& options, const BleedingTarget* bleeding) {
  if (g_buffer.colours != 0 || (!options.luminance && bleeding == nullptr)) return;
  throw std::invalid_argument(
      fmt::format("colours must be given for {}, not 0", options.luminance ? "luminance" : "bleeding"));
}

void validate(const BleedingTarget& bleeding, const GBuffer& g_buffer) {
  require_size("bleeding", bleeding.texture, {g_buffer.picture_width(), g_buffer.picture_height(), bleeding.part});
  require_format("bleeding", bleeding.texture,
                 "GL_RGBA8, GL_RGBA16, GL_RGBA16F, GL_RGBA32F, GL_RGB10_A2 and GL_R11F_G11F_B10F",
                 {GL_RGBA8, GL_RGBA16, GL_RGBA16F, GL_RGBA32F, GL_RGB10_A2, GL_R11F_G11F_B10F});
}

// Of the ray through the middle of a pixel, which may lie beyond the picture.
struct Line {
  glm::dvec3 point, direction;  // where it is 0 along the view; by 1 along the view
};

Line line_of(const ViewBlock& view, double x, double y) {
  const glm::dmat4 view_from_clip = glm::inverse(glm::dmat4(view.clip_from_view));
  const auto unproject = [&](double depth) {
    const glm::dvec4 h =
        view_from_clip * glm::dvec4((2 * x + 1) / view.width - 1, (2 * y + 1) / view.height - 1, depth, 1);
    return glm::dvec3(h) / h.w;
  };
  // Two depths that are finite whatever the far plane.
  const glm::dvec3 a = unproject(0.25), b = unproject(0.5);
  const glm::dvec3 direction = (b - a) / (a.z - b.z);
  return {a + a.z * direction, direction};
}

void set_lines(const ViewBlock& view, VaoBlock& block) {
  const auto vector_at = [&](double x, double y) {
    const Line line = line_of(view, x, y);
    return view.is_perspective != 0 ? line.direction : line.point;
  };
  const glm::dvec3 first = vector_at(0, 0);
  block.line_first = glm::vec4(first, 0);
  block.line_right = glm::vec4(vector_at(1, 0) - first, 0);
  block.line_up = glm::vec4(vector_at(0, 1) - first, 0);
  block.parallel = glm::vec4(line_of(view, 0, 0).direction, 0);
}

void set_luminance(const LuminanceSensitivity& luminance, VaoBlock& block) {
  block.luminance_begin = luminance.threshold - luminance.width;
  block.luminance_scale = 0.5f / luminance.width;
  block.luminance_sigma = luminance.sigma;
  block.uses_value = luminance.brightness == Brightness::value;
}

void set_places(VaoBlock& block) {
  const auto& sets = sample_sets();
  static_assert(2 * std::extent_v<decltype(VaoBlock::places)> == kSampleSetTotal);
  for (std::size_t i = 0; i < sets.size(); i += 2) block.places[i / 2] = glm::vec4(sets[i], sets[i + 1]);
}

int culling_of(VaoCulling culling) {
  return culling == VaoCulling::off      ? LKAO_VAO_CULL_NOTHING
         : culling == VaoCulling::greedy ? LKAO_VAO_CULL_GREEDILY
                                         : LKAO_VAO_CULL_CAREFULLY;
}

int tile_count(int size) { return (size + LKAO_VAO_TILE - 1) / LKAO_VAO_TILE; }

VaoBlock make_block(const VaoOptions& options, const ViewBlock& view, const BleedingTarget* bleeding) {
  VaoBlock block{};
  set_places(block);
  set_lines(view, block);
  block.ball_radius = 0.5f * options.radius;
  block.radius = options.radius;
  block.thickness = std::isinf(options.thickness) ? -1.0f : options.thickness;
  const bool has_set = options.sample_count <= kLargestSet;
  block.largest_size = has_set ? options.sample_count : 0;
  block.sequence_size = has_set ? 0 : options.sample_count;
  block.seed = options.seed;
  block.fewest_samples_width = options.fewest_samples_width;
  block.culling = culling_of(options.culling);
  block.tile_columns = tile_count(view.width);
  block.tile_rows = tile_count(view.height);
  if (options.luminance) set_luminance(*options.luminance, block);
  if (bleeding != nullptr) {
    const Part first = bleeding->part.value_or(Part{});
    block.bleeding_stride = options.bleeding_stride;
    block.bleeding_steps = steps_to_one(bleeding->texture);
    block.bleeding_x = first.x;
    block.bleeding_y = first.y;
  }
  return block;
}

}  // namespace

struct VaoPass::State {
  explicit State(const VaoPassSetup& wanted)
      : setup(wanted),
        find_tiles(make_program({"screen/vao/tiles.comp"}, {{"LKAO_COUNT", wanted.count}})),
        find_occlusion(make_program({"screen/vao/vao.comp"}, {{"LKAO_COUNT", wanted.count}})) {}

  StateUse use() const {
    return {.texture_targets = kVaoTargets,
            .image_count = LKAO_VAO_IMAGE_COUNT,
            .block_count = LKAO_BLOCK_COUNT,
            .counts = setup.count};
  }
  // The steps of a frame, after the receivers.
  void begin_counting();
  void try_tiles(const VaoBlock& values);
  void bind_colours(const GBuffer& g_buffer, const BleedingTarget* bleeding) const;
  void make_room(int columns, int rows);

  VaoPassSetup setup;
  Picture picture;
  UniformBuffer<VaoBlock> block;
  ProgramObject find_tiles, find_occlusion;
  FragmentCounters counters;
  bool is_counted = false;
  Texture tiles;
  int room_columns = 0, room_rows = 0;
};

void VaoPass::State::begin_counting() {
  if (setup.count) counters.begin();
  is_counted = setup.count;
}

void VaoPass::State::make_room(int columns, int rows) {
  if (columns <= room_columns && rows <= room_rows) return;
  const Size size = grown_size({columns, rows}, {room_columns, room_rows});
  tiles = make_texture(GL_TEXTURE_2D);
  room_columns = room_rows = 0;
  glTextureStorage2D(tiles.name(), 1, GL_R32F, size.width, size.height);
  check_errors("making room for the tiles of a picture");
  room_columns = size.width;
  room_rows = size.height;
}

void VaoPass::State::try_tiles(const VaoBlock& values) {
  if (values.culling == LKAO_VAO_CULL_NOTHING) return;
  make_room(values.tile_columns, values.tile_rows);
  glUseProgram(find_tiles.name());
  glBindImageTexture(0, tiles.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
  dispatch_over_pixels(values.tile_columns, values.tile_rows);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  glBindTextureUnit(LKAO_UNIT_VAO_TILES, tiles.name());
  glBindSampler(LKAO_UNIT_VAO_TILES, picture.plain_sampler().name());
}

void VaoPass::State::bind_colours(const GBuffer& g_buffer, const BleedingTarget* bleeding) const {
  // Not without one: that would unbind textures of all targets.
  if (g_buffer.colours != 0) glBindTextureUnit(LKAO_UNIT_VAO_COLOURS, g_buffer.colours);
  glBindSampler(LKAO_UNIT_VAO_COLOURS, picture.plain_sampler().name());
  if (bleeding != nullptr) bind_image(LKAO_IMAGE_VAO_BLEEDING, bleeding->texture);
}

VaoPass::VaoPass(const VaoPassSetup& setup) {
  require_clean_context(setup.host_errors);
  state_ = std::make_unique<State>(setup);
  sample_sets();  // now, so that no frame waits for them
  check_errors("making a VaoPass");
}

VaoPass::~VaoPass() = default;
VaoPass::VaoPass(VaoPass&&) noexcept = default;
VaoPass& VaoPass::operator=(VaoPass&&) noexcept = default;

void VaoPass::draw(const GBuffer& g_buffer, const Camera& camera, const VaoOptions& options, const OcclusionTarget& to,
                   const BleedingTarget* bleeding) {
  State& state = *state_;
  require_clean_context(state.setup.host_errors);
  check(options);
  require_colours(g_buffer, options, bleeding);
  validate(g_buffer);
  validate(to, g_buffer.picture_width(), g_buffer.picture_height());
  if (bleeding != nullptr) validate(*bleeding, g_buffer);
  const ViewBlock view = make_view_block(g_buffer, camera);
  const VaoBlock block = make_block(options, view, bleeding);
  const StateKeeper keeper(state.use(), state.setup.keep_state);
  state.picture.find_receivers(g_buffer, view);
  state.block.set_and_bind(block);
  state.begin_counting();
  state.try_tiles(block);
  state.bind_colours(g_buffer, bleeding);
  state.picture.write(state.find_occlusion, to);
  check_errors("finding volumetric occlusion");
}

VaoCounts VaoPass::read_counts() const {
  require_clean_context(state_->setup.host_errors);
  if (!state_->is_counted) throw std::runtime_error("read_counts() needs VaoPassSetup::count and a draw()");
  const auto [receivers, culled, samples] = state_->counters.read();
  return {receivers, culled, samples};
}

std::optional<VaoPass> VaoPass::try_make(const VaoPassSetup& setup, Status& status) noexcept {
  std::optional<VaoPass> pass;
  status = status_of([&] { pass.emplace(setup); });
  return pass;
}

Status VaoPass::try_draw(const GBuffer& g_buffer, const Camera& camera, const VaoOptions& options,
                         const OcclusionTarget& to, const BleedingTarget* bleeding) noexcept {
  return status_of([&] { draw(g_buffer, camera, options, to, bleeding); });
}

}  // namespace lkao::gl
