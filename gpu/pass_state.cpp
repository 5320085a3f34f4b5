#include "gpu/pass_state.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "gpu/g_buffer.h"
#include "gpu/self_test.h"
#include "gpu/view.h"
#include "lut/random.h"
#include "lut/ray_options.h"

namespace lkao::gl {
namespace {

// Texels as they are: whatever filter or comparison the texture's owner has set.
Sampler make_plain_sampler() {
  GLuint name = 0;
  glCreateSamplers(1, &name);
  glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return Sampler(name);
}

std::uint32_t flags_of(const Culls& culls) {
  return (culls.far_depth ? LKAO_FLAG_CULL_FAR_DEPTH : 0u) | (culls.bounding_sphere ? LKAO_FLAG_CULL_SPHERE : 0u) |
         (culls.facing ? LKAO_FLAG_CULL_FACING : 0u) | (culls.plane_distance ? LKAO_FLAG_CULL_PLANE_DISTANCE : 0u) |
         (culls.horizon ? LKAO_FLAG_CULL_HORIZON : 0u) | (culls.reach ? LKAO_FLAG_CULL_REACH : 0u);
}

}  // namespace

OcclusionPass::State::State(const PassSetup& wanted) : setup(wanted) {
  setup.geometry = choose(wanted.geometry);
  setup.accumulator = choose(wanted.accumulator);
  uniform_buffer = make_buffer(sizeof(PassUniforms), nullptr, GL_DYNAMIC_STORAGE_BIT);
  counters = make_buffer(24, nullptr, GL_DYNAMIC_STORAGE_BIT);
  sampler = make_plain_sampler();
  no_attributes = make_vertex_array();
  classify = make_program({"classify.comp"});
  receivers = make_program({"receivers.comp"});
  depth = make_program({"screen.vert", "depth.frag"});
  cast = make_program({"cast.comp"});
  resolve = make_program({"resolve.comp"});
}

// By themselves, writes of shaders wait for nothing that came before, and clears and copies do not wait for writes of
// shaders: the last frame may still be reading what this one is about to write.
void OcclusionPass::State::wait_for_last_frame() const {
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                  GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT | GL_ATOMIC_COUNTER_BARRIER_BIT);
}

void OcclusionPass::State::set_uniforms(const GBuffer& g_buffer, const Camera& camera, const RayOptions& options,
                                        const RasterOptions& raster) {
  uniforms = PassUniforms();
  uniforms.flags.x = flags_of(raster.culls) | (options.sidedness == Sidedness::two_sided ? LKAO_FLAG_TWO_SIDED : 0u) |
                     (occluders.has_ranges() ? LKAO_FLAG_RANGES : 0u) |
                     (std::isinf(options.radius) ? LKAO_FLAG_UNBOUNDED : 0u);
  // Any radius will do until find_radius() knows.
  const float radius = std::isinf(options.radius) ? 1.0f : options.radius;
  set_view(camera, g_buffer.width, g_buffer.height, radius, uniforms);
  bind(g_buffer, camera, uniforms);
  table->set_uniforms(uniforms);
  uniforms.lengths.x = radius;
  uniforms.lengths.y = raster.billboard_threshold;
  uniforms.lengths.z = lut::relative_surface_offset(options);
  uniforms.jitter.x = options.jitter.rotation;
  uniforms.jitter.y = lut::largest_tilt(options.jitter, table->lowest_elevation());
  const std::uint64_t seed = lut::mix_bits(options.seed);
  uniforms.flags.z = static_cast<std::uint32_t>(seed);
  uniforms.flags.w = static_cast<std::uint32_t>(seed >> 32);
}

void OcclusionPass::State::bind_uniforms() const {
  glNamedBufferSubData(uniform_buffer.name(), 0, sizeof(uniforms), &uniforms);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, uniform_buffer.name());
  for (int unit :
       {LKAO_UNIT_RECEIVERS, LKAO_UNIT_MASKS, LKAO_UNIT_PLACE, LKAO_UNIT_NORMALS, LKAO_UNIT_GEOMETRIC_NORMALS}) {
    glBindSampler(static_cast<GLuint>(unit), sampler.name());
  }
}

void OcclusionPass::State::dispatch_over_pixels() const {
  glDispatchCompute(static_cast<GLuint>((targets.width() + 7) / 8), static_cast<GLuint>((targets.height() + 7) / 8), 1);
}

void OcclusionPass::State::classify_occluders() {
  occluders.classify(classify.name(), (uniforms.flags.x & LKAO_FLAG_TWO_SIDED) != 0);
}

void OcclusionPass::State::find_receivers() {
  glUseProgram(receivers.name());
  glBindImageTexture(0, targets.receivers(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA32F);
  dispatch_over_pixels();
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
  glBindTextureUnit(LKAO_UNIT_RECEIVERS, targets.receivers());
}

// Receivers start at a distance from the surface that classifying finds, and shapes need the radius, which the
// receivers tell: so triangles are classified twice. That is nothing beside shapes as large as the scene.
void OcclusionPass::State::find_radius() {
  if ((uniforms.flags.x & LKAO_FLAG_UNBOUNDED) == 0) return;
  unbounded_radius.put_into(uniform_buffer.name(), (uniforms.flags.x & LKAO_FLAG_PERSPECTIVE) != 0);
  classify_occluders();
}

void OcclusionPass::State::draw_depths() {
  targets.bind_depth();
  glUseProgram(depth.name());
  glBindVertexArray(no_attributes.name());
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_ALWAYS);
  glDepthMask(GL_TRUE);
  // The program writes no colour.
  for (GLuint i = 0; i < 8; ++i) glColorMaski(i, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  for (GLuint i = 0; i < 8; ++i) glColorMaski(i, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_FALSE);
}

// Sec. 4, step 3: "rasterize far side of the shape", "inverted depth test", "do not perform depth writes".
void OcclusionPass::State::draw_shapes(const Camera& camera) {
  targets.bind_masks();
  table->bind();
  if (setup.count_fragments) {
    const GLuint zeros[6] = {};
    glNamedBufferSubData(counters.name(), 0, sizeof(zeros), zeros);
    glBindBufferBase(GL_ATOMIC_COUNTER_BUFFER, 0, counters.name());
  }
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
  glUseProgram(shapes.prism.name());
  occluders.draw(Shape::prism, setup.geometry);
  glDisable(GL_CULL_FACE);
  glUseProgram(shapes.billboard.name());
  occluders.draw(Shape::billboard, setup.geometry);
  glDisable(GL_COLOR_LOGIC_OP);
  glDisable(GL_DEPTH_CLAMP);
  glDisable(GL_DEPTH_TEST);
  targets.finish_masks();
}

void OcclusionPass::State::drop_rays_not_cast() {
  const bool all_are_cast = (uniforms.flags.x & LKAO_FLAG_GEOMETRIC_NORMALS) == 0 && uniforms.jitter.y <= 0;
  if (all_are_cast) return;
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  glUseProgram(cast.name());
  glBindImageTexture(0, targets.masks(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_RGBA32UI);
  dispatch_over_pixels();
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
}

void OcclusionPass::State::require_drawn() const {
  if (!is_drawn) throw std::runtime_error("nothing to resolve or to read: no draw() came before");
}

}  // namespace lkao::gl
