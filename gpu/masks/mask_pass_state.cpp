#include "gpu/masks/mask_pass_state.h"

#include <cmath>
#include <iterator>
#include <stdexcept>

#include "gpu/frame/g_buffer.h"
#include "gpu/frame/occlusion_target.h"
#include "gpu/frame/view.h"
#include "gpu/masks/logic_op_check.h"
#include "gpu/mesh/geometry_check.h"
#include "lut/random.h"
#include "lut/ray_options.h"

namespace lkao::gl {
namespace {

// By unit.
constexpr GLenum kTextureTargets[] = {
    GL_TEXTURE_2D,       GL_TEXTURE_2D,     GL_TEXTURE_2D,     GL_TEXTURE_2D,         // frame
    GL_TEXTURE_BUFFER,   GL_TEXTURE_BUFFER, GL_TEXTURE_BUFFER, GL_TEXTURE_BUFFER,     // mesh
    GL_TEXTURE_BUFFER,   GL_TEXTURE_BUFFER, GL_TEXTURE_BUFFER,                        // mesh
    GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BUFFER, GL_TEXTURE_BUFFER, GL_TEXTURE_2D_ARRAY};  // masks
static_assert(std::size(kTextureTargets) == LKAO_MASK_PASS_UNIT_COUNT);

void describe(const Culls& culls, MaskPassBlock& block) {
  block.culls_far_depth = culls.far_depth;
  block.culls_by_sphere = culls.bounding_sphere;
  block.culls_by_facing = culls.facing;
  block.culls_by_plane = culls.plane_distance;
  block.culls_by_horizon = culls.horizon;
  block.culls_by_reach = culls.reach;
}

}  // namespace

const StateUse kDrawUse{.texture_targets = kTextureTargets,
                        .image_count = 1,
                        .storage_count = LKAO_STORAGE_MASKS_COUNT,
                        .block_count = LKAO_BLOCK_COUNT,
                        .counts = true,
                        .draws = true,
                        .moves_pixels = true};
const StateUse kResolveUse{
    .texture_targets = kTextureTargets, .image_count = LKAO_MASK_PASS_IMAGE_COUNT, .block_count = LKAO_BLOCK_COUNT};
const StateUse kReadUse{.moves_pixels = true};

MaskPass::State::State(const MaskPassSetup& wanted)
    : setup(wanted),
      plain_sampler(make_plain_sampler()),
      no_attributes(make_vertex_array()),
      classify(make_program({"mesh/classify.comp"})),
      receivers(make_program({"masks/receivers.comp"})),
      depth(make_program({"frame/screen.vert", "masks/depth.frag"})),
      cast(make_program({"masks/cast.comp"})),
      resolve(make_program({"masks/resolve.comp"})) {
  setup.geometry = choose(wanted.geometry);
  setup.accumulator = choose(wanted.accumulator);
}

void MaskPass::State::set_table(const PlaneMaskTable& wanted) {
  TableBuffer buffer(wanted);
  const Defines defines = {{"LKAO_LAYERS", buffer.layer_count()},
                           {"LKAO_MUST_MAY", buffer.has_bounds()},
                           {"LKAO_CUBE_ADDRESSING", buffer.is_cube()},
                           {"LKAO_DOUBLE", setup.precision == Precision::double_precision},
                           {"LKAO_ATOMICS", setup.accumulator == Accumulator::ssbo},
                           {"LKAO_COUNT", setup.count_fragments}};
  programs = make_shape_programs(setup.geometry, "masks/accumulate.frag", defines);
  table = std::move(buffer);
  is_drawn = false;
}

void MaskPass::State::make_images(int width, int height) {
  images.make_room(width, height, table->layer_count(), setup.accumulator == Accumulator::ssbo);
}

// By themselves, writes of shaders wait for nothing that came before, and clears and copies do not wait for writes of
// shaders: the last frame may still be reading what this one is about to write.
void MaskPass::State::wait_for_last_frame() const {
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                  GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT | GL_ATOMIC_COUNTER_BARRIER_BIT);
}

void MaskPass::State::describe(const MeshBuffers& mesh, const GBuffer& g_buffer, const Camera& camera,
                               const RayOptions& options, const RasterOptions& raster) {
  view = make_view_block(g_buffer, camera);

  shapes_block = {};
  // Any radius will do until find_radius() knows.
  set_camera(camera, pixels_of(g_buffer), view, std::isinf(options.radius) ? 1.0f : options.radius, shapes_block);
  shapes_block.is_unbounded = std::isinf(options.radius);
  shapes_block.is_two_sided = options.sidedness == Sidedness::two_sided;
  shapes_block.has_ranges = mesh.has_ranges();
  shapes_block.billboard_threshold = raster.billboard_threshold;
  shapes_block.min_distance = options.min_distance;
  shapes_block.relative_surface_offset = lut::relative_surface_offset(options);
  shapes_block.is_offset_automatic = lut::has_automatic_offset(options);

  block = {};
  table->describe(block);
  gl::describe(raster.culls, block);
  block.jitter_rotation = options.jitter.rotation;
  block.jitter_tilt = lut::largest_tilt(options.jitter, table->lowest_elevation());
  const std::uint64_t seed = lut::mix_bits(options.seed);
  block.seed_low = static_cast<std::uint32_t>(seed);
  block.seed_high = static_cast<std::uint32_t>(seed >> 32);
}

void MaskPass::State::bind_inputs(const GBuffer& g_buffer) const {
  bind_blocks();
  bind(g_buffer, plain_sampler);
  unbounded_radius.begin();
}

void MaskPass::State::check_inputs(const GBuffer& g_buffer, const RayOptions& options) {
  if (!setup.check_g_buffer) return;
  check.look_at(g_buffer);
  warnings = check.remarks(options);
}

void MaskPass::State::bind_blocks() const {
  view_buffer.set_and_bind(view);
  shapes_buffer.set_and_bind(shapes_block);
  block_buffer.set_and_bind(block);
  for (int unit : {LKAO_UNIT_RECEIVERS, LKAO_UNIT_MASKS}) {
    glBindSampler(static_cast<GLuint>(unit), plain_sampler.name());
  }
}

void MaskPass::State::classify_occluders(const MeshBuffers& mesh) {
  shapes.classify(mesh, classify.name(), shapes_block.is_two_sided != 0);
}

void MaskPass::State::find_receivers() {
  glUseProgram(receivers.name());
  glBindImageTexture(0, images.receivers(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA32F);
  dispatch_over_pixels(images.width(), images.height());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
  glBindTextureUnit(LKAO_UNIT_RECEIVERS, images.receivers());
}

// Receivers start at a distance from the surface that classifying finds, and shapes need the radius, which the
// receivers tell: so triangles are classified twice. That is nothing beside shapes as large as the scene.
void MaskPass::State::find_radius(const MeshBuffers& mesh) {
  if (shapes_block.is_unbounded == 0) return;
  unbounded_radius.put_into(shapes_buffer.name(), view.is_perspective != 0);
  classify_occluders(mesh);
}

void MaskPass::State::draw_depths() {
  images.bind_depth();
  glUseProgram(depth.name());
  glBindVertexArray(no_attributes.name());
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_ALWAYS);
  glDepthMask(GL_TRUE);
  // The program writes no colour.
  for (GLuint i = 0; i < kKeptColorCount; ++i) glColorMaski(i, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  for (GLuint i = 0; i < kKeptColorCount; ++i) glColorMaski(i, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_FALSE);
}

// Sec. 4, step 3: "rasterize far side of the shape", "inverted depth test", "do not perform depth writes".
void MaskPass::State::draw_shapes(const MeshBuffers& mesh, const Camera& camera) {
  images.bind_masks();
  table->bind();
  if (setup.count_fragments) counters.begin();
  glDepthFunc(GL_LESS);
  // Shapes reach before the near and beyond the far plane, and behind the eye.
  glEnable(GL_DEPTH_CLAMP);
  if (setup.accumulator == Accumulator::logic_op) {
    glEnable(GL_COLOR_LOGIC_OP);
    glLogicOp(GL_OR);
  }
  glEnable(GL_CULL_FACE);
  glCullFace(GL_FRONT);
  glFrontFace(is_mirrored(camera) ? GL_CW : GL_CCW);
  glUseProgram(programs.prism.name());
  shapes.draw(mesh, Shape::prism, setup.geometry);
  glDisable(GL_CULL_FACE);
  glUseProgram(programs.billboard.name());
  shapes.draw(mesh, Shape::billboard, setup.geometry);
  glDisable(GL_COLOR_LOGIC_OP);
  glDisable(GL_DEPTH_CLAMP);
  glDisable(GL_DEPTH_TEST);
  images.finish_masks();
}

void MaskPass::State::drop_rays_not_cast() {
  const bool all_are_cast = view.has_geometric_normals == 0 && block.jitter_tilt <= 0;
  if (all_are_cast) return;
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  glUseProgram(cast.name());
  glBindImageTexture(0, images.masks(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_RGBA32UI);
  dispatch_over_pixels(images.width(), images.height());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
}

void MaskPass::State::write_targets(const ResolveTargets& written) {
  block.writes_occlusion = written.occlusion.texture != 0;
  block.writes_bent_normals = written.bent_normals != 0;
  bind(written.occlusion, target_buffer, plain_sampler);
  if (written.bent_normals != 0) bind_image(LKAO_IMAGE_BENT_NORMALS, written.bent_normals);
  bind_blocks();
  table->bind();
  glBindTextureUnit(LKAO_UNIT_RECEIVERS, images.receivers());
  glBindTextureUnit(LKAO_UNIT_MASKS, images.masks());
  glUseProgram(resolve.name());
  begin_writing_targets();
  dispatch_over_pixels(images.width(), images.height());
  end_writing_targets();
}

void MaskPass::State::require_drawn() const {
  if (!is_drawn) throw std::runtime_error("nothing to resolve or to read: no draw() came before");
}

}  // namespace lkao::gl
