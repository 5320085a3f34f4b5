#include "gpu/volumes/volume_pass_state.h"

#include <cstdint>
#include <iterator>
#include <limits>

#include "gpu/frame/g_buffer.h"
#include "gpu/frame/occlusion_target.h"
#include "gpu/frame/view.h"
#include "gpu/mesh/geometry_check.h"
#include "gpu/mesh/shapes.h"
#include "gpu/volumes/units.h"
#include "lut/ray_options.h"

namespace lkao::gl {
namespace {

// By unit.
constexpr GLenum kVolumeTextureTargets[] = {
    GL_TEXTURE_2D,     GL_TEXTURE_2D,     GL_TEXTURE_2D,     GL_TEXTURE_2D,      // frame
    GL_TEXTURE_BUFFER, GL_TEXTURE_BUFFER, GL_TEXTURE_BUFFER, GL_TEXTURE_BUFFER,  // mesh
    GL_TEXTURE_BUFFER, GL_TEXTURE_BUFFER, GL_TEXTURE_BUFFER,                     // mesh
    GL_TEXTURE_2D,     GL_TEXTURE_2D,     GL_TEXTURE_2D,     GL_TEXTURE_2D,      // volumes
    GL_TEXTURE_BUFFER};                                                          // volumes
static_assert(std::size(kVolumeTextureTargets) == LKAO_VOLUME_PASS_UNIT_COUNT);

// Both ends and the three sides of a volume; as volume.glsl numbers its vertices.
constexpr std::uint16_t kVolumeIndices[] = {0, 2, 1, 3, 4, 5,                                       // ends
                                            0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 2, 0, 3, 2, 3, 5};  // sides
constexpr Solid kVolume{LKAO_VOLUME_VERTEX_COUNT, kVolumeIndices};

// Of the farthest corner of a volume whose extensions are clamped, in radii: 2 sideways and 1 up.
constexpr float kClampedReach = 2.25f;

ProgramObject make_volume_program(const VolumePassSetup& setup, bool has_two_horizons) {
  const Defines defines = {{"LKAO_KEPT", setup.keeps_volumes},
                           {"LKAO_TWO_HORIZONS", has_two_horizons},
                           {"LKAO_COUNT", setup.count_fragments}};
  if (setup.geometry == GeometryBackEnd::geometry_shader) {
    return make_program({"mesh/point.vert", "volumes/volume.geom", "volumes/accumulate.frag"}, defines);
  }
  return make_program({"volumes/volume.vert", "volumes/accumulate.frag"}, defines);
}

}  // namespace

const StateUse kVolumesUse{.texture_targets = kVolumeTextureTargets,
                           .image_count = LKAO_FRAME_IMAGE_COUNT,
                           .storage_count = LKAO_MESH_STORAGE_COUNT,
                           .block_count = LKAO_BLOCK_COUNT,
                           .counts = true,
                           .draws = true,
                           .blends = true};

VolumePass::State::State(const VolumePassSetup& wanted)
    : setup(wanted),
      lists(kVolume),
      plain_sampler(make_plain_sampler()),
      no_attributes(make_vertex_array()),
      classify(make_program({"mesh/classify.comp"})),
      receivers(make_program({"frame/screen.vert", "volumes/receivers.frag"})),
      resolve_program(make_program({"volumes/resolve.comp"})) {
  setup.geometry = choose(wanted.geometry);
  if (setup.keeps_volumes) extend = make_program({"volumes/extend.comp"});
  for (const bool has_two_horizons : {false, true}) {
    volumes[has_two_horizons] = make_volume_program(setup, has_two_horizons);
  }
}

void VolumePass::State::make_images(const GBuffer& g_buffer) {
  images.make_room(g_buffer.picture_width(), g_buffer.picture_height(), setup.accessibility,
                   g_buffer.geometric_normals != 0);
}

// The last frame may still be reading what this one is about to write (as in MaskPass).
void VolumePass::State::wait_for_last_frame() const {
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT | GL_ATOMIC_COUNTER_BARRIER_BIT);
}

void VolumePass::State::describe(const MeshBuffers& mesh, const GBuffer& g_buffer, const Camera& camera,
                                 const RayOptions& options, const VolumeOptions& wanted) {
  view = make_view_block(g_buffer, camera);

  shapes = {};
  set_camera(camera, pixels_of(g_buffer), view, options.radius, shapes);
  shapes.is_two_sided = options.sidedness == Sidedness::two_sided;
  shapes.has_opacities = mesh.has_opacities();
  // No billboard for any. What is kept must not depend on the camera.
  shapes.billboard_threshold = -1;
  shapes.reach =
      setup.keeps_volumes || !wanted.clamps_extensions ? std::numeric_limits<float>::infinity() : kClampedReach;
  shapes.relative_surface_offset = lut::relative_surface_offset(options);
  shapes.is_offset_automatic = lut::has_automatic_offset(options);

  block = {};
  block.compensation = glm::vec4(wanted.compensation, 0);
  block.clamps_extensions = wanted.clamps_extensions;
}

void VolumePass::State::bind_inputs(const GBuffer& g_buffer) const {
  view_buffer.set_and_bind(view);
  shapes_buffer.set_and_bind(shapes);
  block_buffer.set_and_bind(block);
  bind(g_buffer, plain_sampler);
}

void VolumePass::State::check_inputs(const GBuffer& g_buffer, const RayOptions& options) {
  if (!setup.check_g_buffer) return;
  check.look_at(g_buffer);
  warnings = check.remarks(options);
}

void VolumePass::State::find_volumes(const MeshBuffers& mesh) {
  const KeptVolumes::Key key{mesh.version(), shapes.radius, block.clamps_extensions != 0};
  if (setup.keeps_volumes && kept.have(key)) {
    mesh.bind_positions();
    lists.bind_largest();
    return;
  }
  lists.classify(mesh, classify.name(), shapes.is_two_sided != 0);
  if (setup.keeps_volumes) kept.find(key, mesh, lists, extend.name());
}

void VolumePass::State::draw_receivers() const {
  images.bind_receivers();
  glUseProgram(receivers.name());
  glBindVertexArray(no_attributes.name());
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_ALWAYS);
  glDepthMask(GL_TRUE);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthMask(GL_FALSE);
}

// Steps 1, 2 and 4.
void VolumePass::State::draw_volumes(const MeshBuffers& mesh, const Camera& camera) {
  images.bind_accessibility(plain_sampler);
  if (setup.count_fragments) counters.begin();
  glDepthFunc(GL_LESS);
  glEnable(GL_DEPTH_CLAMP);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_FRONT);
  glFrontFace(is_mirrored(camera) ? GL_CW : GL_CCW);
  glEnablei(GL_BLEND, 0);
  glBlendFunci(0, GL_ONE, GL_ONE);
  glBlendEquationi(0, GL_FUNC_REVERSE_SUBTRACT);
  glUseProgram(volumes[view.has_geometric_normals].name());
  lists.draw(mesh, Shape::prism, setup.geometry, [&](std::size_t part) {
    if (setup.keeps_volumes) kept.bind(part);
  });
  glDisablei(GL_BLEND, 0);
  glDisable(GL_CULL_FACE);
  glDisable(GL_DEPTH_CLAMP);
  glDisable(GL_DEPTH_TEST);
}

void VolumePass::State::resolve(const OcclusionTarget& to) const {
  images.bind_result(plain_sampler);
  bind(to, target_buffer, plain_sampler);
  glUseProgram(resolve_program.name());
  begin_writing_targets();
  dispatch_over_pixels(images.width(), images.height());
  end_writing_targets();
}

}  // namespace lkao::gl
