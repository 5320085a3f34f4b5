// A pass leaves OpenGL as it found it, and works whatever it finds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

#include "gpu/gl/program.h"
#include "gpu/gl/state_keeper.h"
#include "gpu/on_software.h"
#include "gpu/pass_scene.h"

namespace lkao::gl::tests {
namespace {

using ::testing::IsEmpty;
using ::testing::Not;

constexpr int kWidth = 48;
constexpr int kHeight = 36;

using Enums = std::initializer_list<GLenum>;
// All that a renderer may have set, by name.
using Snapshot = std::map<std::string, std::vector<double>>;

#define LKAO_ENTRY(NAME) \
  { #NAME, NAME }
struct Entry {
  const char* name;
  GLenum value;
};

constexpr Entry kValues[] = {LKAO_ENTRY(GL_CURRENT_PROGRAM),
                             LKAO_ENTRY(GL_VERTEX_ARRAY_BINDING),
                             LKAO_ENTRY(GL_DRAW_FRAMEBUFFER_BINDING),
                             LKAO_ENTRY(GL_READ_FRAMEBUFFER_BINDING),
                             LKAO_ENTRY(GL_ACTIVE_TEXTURE),
                             LKAO_ENTRY(GL_UNIFORM_BUFFER_BINDING),
                             LKAO_ENTRY(GL_SHADER_STORAGE_BUFFER_BINDING),
                             LKAO_ENTRY(GL_ATOMIC_COUNTER_BUFFER_BINDING),
                             LKAO_ENTRY(GL_DRAW_INDIRECT_BUFFER_BINDING),
                             LKAO_ENTRY(GL_ARRAY_BUFFER_BINDING),
                             LKAO_ENTRY(GL_PIXEL_PACK_BUFFER_BINDING),
                             LKAO_ENTRY(GL_PIXEL_UNPACK_BUFFER_BINDING),
                             LKAO_ENTRY(GL_VIEWPORT),
                             LKAO_ENTRY(GL_DEPTH_RANGE),
                             LKAO_ENTRY(GL_SCISSOR_BOX),
                             LKAO_ENTRY(GL_DEPTH_FUNC),
                             LKAO_ENTRY(GL_DEPTH_WRITEMASK),
                             LKAO_ENTRY(GL_CULL_FACE_MODE),
                             LKAO_ENTRY(GL_FRONT_FACE),
                             LKAO_ENTRY(GL_LOGIC_OP_MODE),
                             LKAO_ENTRY(GL_CLIP_ORIGIN),
                             LKAO_ENTRY(GL_CLIP_DEPTH_MODE),
                             LKAO_ENTRY(GL_POLYGON_MODE),
                             LKAO_ENTRY(GL_COLOR_CLEAR_VALUE),
                             LKAO_ENTRY(GL_DEPTH_CLEAR_VALUE),
                             LKAO_ENTRY(GL_STENCIL_FUNC),
                             LKAO_ENTRY(GL_BLEND_SRC_RGB),
                             LKAO_ENTRY(GL_POLYGON_OFFSET_FACTOR)};

// Those that passes leave alone; the others are kKeptCapabilities.
constexpr GLenum kOtherCapabilities[] = {GL_SCISSOR_TEST, GL_BLEND, GL_FRAMEBUFFER_SRGB, GL_MULTISAMPLE};

std::string numbered(const char* what, std::size_t number) { return what + (" " + std::to_string(number)); }

Snapshot take_snapshot() {
  Snapshot snapshot;
  for (const Entry& entry : kValues) {
    std::vector<double> values(4, 0.0);
    glGetDoublev(entry.value, values.data());
    snapshot[entry.name] = values;
  }
  for (const GLenum capability : kKeptCapabilities)
    snapshot[numbered("capability", capability)] = {static_cast<double>(glIsEnabled(capability))};
  for (const GLenum capability : kOtherCapabilities)
    snapshot[numbered("capability", capability)] = {static_cast<double>(glIsEnabled(capability))};
  for (const PixelStore& parameter : kKeptPixelStore) {
    GLint value = 0;
    glGetIntegerv(parameter.name, &value);
    snapshot[numbered("pixel store", parameter.name)] = {static_cast<double>(value)};
  }
  GLint active = 0;
  glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
  for (int unit = 0; unit < 16; ++unit) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    std::vector<double>& values = snapshot[numbered("texture unit", static_cast<std::size_t>(unit))];
    for (const GLenum binding : Enums{GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_2D_ARRAY, GL_TEXTURE_BINDING_BUFFER,
                                      GL_TEXTURE_BINDING_3D, GL_SAMPLER_BINDING}) {
      GLint name = 0;
      glGetIntegerv(binding, &name);
      values.push_back(name);
    }
  }
  glActiveTexture(static_cast<GLenum>(active));
  for (GLuint i = 0; i < 8; ++i) {
    std::vector<double>& values = snapshot[numbered("indexed state", i)];
    for (const GLenum binding :
         Enums{GL_SHADER_STORAGE_BUFFER_BINDING, GL_UNIFORM_BUFFER_BINDING, GL_IMAGE_BINDING_NAME,
               GL_IMAGE_BINDING_FORMAT, GL_IMAGE_BINDING_LAYERED, GL_IMAGE_BINDING_ACCESS}) {
      GLint value = 0;
      glGetIntegeri_v(binding, i, &value);
      values.push_back(value);
    }
    for (const GLenum size :
         Enums{GL_SHADER_STORAGE_BUFFER_START, GL_SHADER_STORAGE_BUFFER_SIZE, GL_UNIFORM_BUFFER_SIZE}) {
      GLint64 value = 0;
      glGetInteger64i_v(size, i, &value);
      values.push_back(static_cast<double>(value));
    }
    for (const GLenum name : kKeptBlending) {
      GLint value = 0;
      glGetIntegeri_v(name, i, &value);
      values.push_back(value);
    }
    values.push_back(glIsEnabledi(GL_BLEND, i));
    GLboolean mask[4] = {};
    glGetBooleani_v(GL_COLOR_WRITEMASK, i, mask);
    values.insert(values.end(), mask, mask + 4);
  }
  return snapshot;
}

// The names of what is no longer as it was.
std::vector<std::string> changes_since(const Snapshot& before) {
  std::vector<std::string> names;
  for (const auto& [name, values] : take_snapshot()) {
    if (values != before.at(name)) names.push_back(name);
  }
  return names;
}

// The unlikely: everything set in a way that would spoil a pass that relies on it.
class OddState {
 public:
  OddState()
      : buffer_(make_buffer(1 << 16, nullptr, 0)),
        texture_(make_image(GL_RGBA8, 4, 4)),
        array_(make_texture(GL_TEXTURE_2D_ARRAY)),
        view_(make_buffer_texture(GL_R32F, buffer_)),
        framebuffer_(make_framebuffer()),
        vertex_array_(make_vertex_array()),
        program_(make_program({"frame/screen.vert", "masks/fill.frag"})) {
    glTextureStorage3D(array_.name(), 1, GL_RGBA8, 4, 4, 2);
    GLuint sampler = 0;
    glCreateSamplers(1, &sampler);
    sampler_ = Sampler(sampler);
    glSamplerParameteri(sampler, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    bind();
    set_pipeline();
  }
  ~OddState() {
    // The next test gets the context's defaults: it has a context of its own.
    glUseProgram(0);
  }

 private:
  void bind() const {
    for (GLuint unit = 0; unit < 16; ++unit) {
      glBindTextureUnit(unit, texture_.name());
      glBindTextureUnit(unit, array_.name());
      glBindTextureUnit(unit, view_.name());
      glBindSampler(unit, sampler_.name());
    }
    for (GLuint i = 0; i < 8; ++i) {
      glBindBufferRange(GL_SHADER_STORAGE_BUFFER, i, buffer_.name(), 256 * i, 512);
      glBindBufferBase(GL_UNIFORM_BUFFER, i, buffer_.name());
      glBindImageTexture(i, array_.name(), 0, GL_TRUE, 0, GL_READ_ONLY, GL_RGBA8);
    }
    for (const GLenum target : Enums{GL_ARRAY_BUFFER, GL_DRAW_INDIRECT_BUFFER, GL_PIXEL_PACK_BUFFER,
                                     GL_PIXEL_UNPACK_BUFFER, GL_ATOMIC_COUNTER_BUFFER}) {
      glBindBuffer(target, buffer_.name());
    }
    glActiveTexture(GL_TEXTURE7);
    glUseProgram(program_.name());
    glBindVertexArray(vertex_array_.name());
    glNamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, texture_.name(), 0);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.name());
  }
  static void set_pipeline() {
    for (const GLenum capability : kKeptCapabilities) glEnable(capability);
    for (const GLenum capability : kOtherCapabilities) glEnable(capability);
    for (GLuint i = 0; i < kKeptColorCount; ++i) {
      glBlendFuncSeparatei(i, GL_DST_COLOR, GL_ZERO, GL_DST_ALPHA, GL_ONE);
      glBlendEquationSeparatei(i, GL_FUNC_REVERSE_SUBTRACT, GL_MIN);
    }
    glDisablei(GL_BLEND, 3);
    glStencilFunc(GL_NEVER, 1, 0xff);
    glSampleMaski(0, 0);
    glSampleCoverage(0.0f, GL_FALSE);
    glPrimitiveRestartIndex(7);
    glScissor(1, 2, 3, 4);
    glViewport(5, 6, 7, 8);
    glDepthRange(0.75, 0.25);
    glDepthFunc(GL_NEVER);
    glDepthMask(GL_FALSE);
    glCullFace(GL_FRONT_AND_BACK);
    glFrontFace(GL_CW);
    glLogicOp(GL_NAND);
    glClipControl(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_POINT);
    glPolygonOffset(3, 4);
    glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
    for (const PixelStore& parameter : kKeptPixelStore) {
      const bool is_alignment = parameter.name == GL_PACK_ALIGNMENT || parameter.name == GL_UNPACK_ALIGNMENT;
      const bool is_flag = parameter.name == GL_PACK_SWAP_BYTES || parameter.name == GL_UNPACK_SWAP_BYTES;
      glPixelStorei(parameter.name, is_alignment ? 8 : is_flag ? GL_TRUE : 3);
    }
  }

  Buffer buffer_;
  Texture texture_, array_, view_;
  Sampler sampler_;
  Framebuffer framebuffer_;
  VertexArray vertex_array_;
  ProgramObject program_;
};

class PassState : public OnSoftware {};

TEST_F(PassState, IsPutBackAndDoesNotMatter) {
  const Mesh mesh = furnished_room();
  const Camera camera = room_camera(kWidth, kHeight);
  const GBufferPass g_buffer(mesh, camera, kWidth, kHeight);
  const PlaneMaskTable table(SamplePattern::standard(192), {.resolution = 32});
  const Texture occlusion = make_image(GL_R32F, kWidth, kHeight), bent = make_image(GL_RGBA16F, kWidth, kHeight);
  const RayOptions options{.radius = 1.0f, .jitter = {.tilt = 0.02f}};
  const MaskPassSetup setups[] = {
      {.accumulator = Accumulator::logic_op, .count_fragments = true},
      {.geometry = GeometryBackEnd::geometry_shader, .accumulator = Accumulator::ssbo, .count_fragments = true}};

  std::vector<std::vector<std::uint64_t>> expected;
  for (const MaskPassSetup& setup : setups) {
    PassOnMesh pass = make_pass(mesh, table, setup);
    pass.draw(g_buffer.by_depth(), camera, options);
    pass.resolve({.occlusion = {occlusion.name()}, .bent_normals = bent.name()});
    expected.push_back(pass.read_masks());
    EXPECT_GT(count_bits(expected.back()), 10000u);
  }

  std::vector<std::vector<std::uint64_t>> masks;
  const OddState odd;
  const Snapshot before = take_snapshot();
  ASSERT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  for (const MaskPassSetup& setup : setups) {
    PassOnMesh pass(setup);
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after the driver's check";
    pass.occluders = Occluders(mesh.positions, mesh.triangles);
    pass.set_table(table);
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after set_table";
    pass.occluders.update_positions(mesh.positions);
    pass.draw(g_buffer.by_depth(), camera, options);
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after draw";
    pass.resolve({.occlusion = {occlusion.name()}, .bent_normals = bent.name()});
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after resolve";
    masks.push_back(pass.read_masks());
    pass.read_receivers();
    pass.read_fragment_counts();
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after reading";
    EXPECT_THROW(pass.draw(g_buffer.by_depth(), {camera.view, glm::mat4(0)}, options), std::invalid_argument);
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after an exception";
  }
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  EXPECT_EQ(masks, expected);
}

TEST_F(PassState, OfVolumesIsPutBackAndDoesNotMatter) {
  const Mesh mesh = furnished_room();
  const Camera camera = room_camera(kWidth, kHeight);
  const GBufferPass g_buffer(mesh, camera, kWidth, kHeight);
  const Texture occlusion = make_image(GL_R32F, kWidth, kHeight);
  const RayOptions options{.radius = 1.0f};
  const VolumePassSetup setups[] = {
      {.count_fragments = true},
      {.geometry = GeometryBackEnd::geometry_shader, .keeps_volumes = true, .count_fragments = true},
      {.keep_state = false}};
  std::vector<std::vector<glm::vec4>> expected;
  for (const VolumePassSetup& setup : setups) {
    VolumePass pass(setup);
    Occluders occluders(mesh.positions, mesh.triangles);
    occluders.set_opacities(std::vector<float>(mesh.triangles.size(), 0.5f));
    pass.draw(occluders, g_buffer.by_depth(), camera, options, {occlusion.name()});
    expected.push_back(read_image(occlusion.name(), kWidth, kHeight));
  }

  for (std::size_t i = 0; i < std::size(setups); ++i) {
    const OddState odd;
    const Snapshot before = take_snapshot();
    VolumePass pass(setups[i]);
    Occluders occluders(mesh.positions, mesh.triangles);
    occluders.set_opacities(std::vector<float>(mesh.triangles.size(), 0.5f));
    if (setups[i].keep_state) {
      EXPECT_THAT(changes_since(before), IsEmpty()) << "after the driver's check";
    }
    pass.draw(occluders, g_buffer.by_depth(), camera, options, {occlusion.name()});
    if (setups[i].keep_state) {
      EXPECT_THAT(changes_since(before), IsEmpty()) << "after draw";
      pass.read_fragment_counts();
      EXPECT_THAT(changes_since(before), IsEmpty()) << "after reading";
      EXPECT_THROW(pass.draw(occluders, g_buffer.by_depth(), {camera.view, glm::mat4(0)}, options, {occlusion.name()}),
                   std::invalid_argument);
      EXPECT_THAT(changes_since(before), IsEmpty()) << "after an exception";
    } else {
      EXPECT_THAT(changes_since(before), Not(IsEmpty()));
    }
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    for (const PixelStore& parameter : kKeptPixelStore) glPixelStorei(parameter.name, parameter.tight);
    EXPECT_EQ(read_image(occlusion.name(), kWidth, kHeight), expected[i]);
  }
}

TEST_F(PassState, OfHorizonsIsPutBackAndDoesNotMatter) {
  const Mesh mesh = furnished_room();
  const Camera camera = room_camera(kWidth, kHeight);
  const GBufferPass g_buffer(mesh, camera, kWidth, kHeight);
  const Texture occlusion = make_image(GL_RGBA16F, kWidth, kHeight);
  const HorizonOptions options{.estimator = HorizonEstimator::bitmask, .radius = 1, .thickness = 0.5f};
  const auto draw = [&](HorizonPass& pass) {
    pass.draw(g_buffer.by_depth(), camera, options, {.texture = occlusion.name(), .channel = Channel::blue});
  };
  HorizonPass usual;
  draw(usual);
  const std::vector<glm::vec4> expected = read_image(occlusion.name(), kWidth, kHeight);
  for (const bool keeps : {true, false}) {
    const OddState odd;
    const Snapshot before = take_snapshot();
    HorizonPass pass({.keep_state = keeps});
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after it is made";
    draw(pass);
    if (keeps) {
      EXPECT_THAT(changes_since(before), IsEmpty()) << "after draw";
      EXPECT_THROW(pass.draw(g_buffer.by_depth(), camera, {}, {occlusion.name()}), std::invalid_argument);
      EXPECT_THAT(changes_since(before), IsEmpty()) << "after an exception";
    } else {
      EXPECT_THAT(changes_since(before), Not(IsEmpty()));
    }
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    for (const PixelStore& parameter : kKeptPixelStore) glPixelStorei(parameter.name, parameter.tight);
    EXPECT_EQ(read_image(occlusion.name(), kWidth, kHeight), expected);
  }
}

TEST_F(PassState, OfBlendingIsPutBack) {
  const OddState odd;
  const Snapshot before = take_snapshot();
  {
    const StateKeeper keeper({.draws = true, .blends = true});
    for (GLuint i = 0; i < kKeptColorCount; ++i) EXPECT_FALSE(glIsEnabledi(GL_BLEND, i));
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    glBlendEquation(GL_FUNC_ADD);
    glColorMask(GL_FALSE, GL_FALSE, GL_TRUE, GL_TRUE);
    EXPECT_THAT(changes_since(before), Not(IsEmpty()));
  }
  EXPECT_THAT(changes_since(before), IsEmpty());
}

TEST_F(PassState, OfAlchemyIsPutBackAndDoesNotMatter) {
  const Camera camera = room_camera(kWidth, kHeight);
  const GBufferPass g_buffer(furnished_room(), camera, kWidth, kHeight);
  const Texture occlusion = make_image(GL_R32F, kWidth, kHeight);
  const AlchemyOptions options{.radius = 0.5f};
  AlchemyPass().draw(g_buffer.by_depth(), camera, options, {occlusion.name()});
  const std::vector<glm::vec4> expected = read_image(occlusion.name(), kWidth, kHeight);
  for (const bool keeps : {true, false}) {
    const OddState odd;
    const Snapshot before = take_snapshot();
    AlchemyPass pass({.keep_state = keeps});
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after it was made";
    pass.draw(g_buffer.by_depth(), camera, options, {occlusion.name()});
    EXPECT_EQ(changes_since(before).empty(), keeps) << "after draw";
    EXPECT_THROW(pass.draw(g_buffer.by_depth(), {camera.view, glm::mat4(0)}, options, {occlusion.name()}),
                 std::invalid_argument);
    EXPECT_EQ(changes_since(before).empty(), keeps) << "after an exception";
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    for (const PixelStore& parameter : kKeptPixelStore) glPixelStorei(parameter.name, parameter.tight);
    EXPECT_EQ(read_image(occlusion.name(), kWidth, kHeight), expected);
  }
}

TEST_F(PassState, MayHaveAProgramThatWasDeletedWhileInUse) {
  const Mesh mesh = furnished_room();
  const Camera camera = room_camera(kWidth, kHeight);
  const GBufferPass g_buffer(mesh, camera, kWidth, kHeight);
  PassOnMesh pass = make_pass(mesh, PlaneMaskTable(SamplePattern::standard(64), {.resolution = 32}));
  ProgramObject program = make_program({"frame/screen.vert", "masks/fill.frag"});
  glUseProgram(program.name());
  program.reset();
  pass.draw(g_buffer.by_depth(), camera, {.radius = 1.0f});
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(PassState, IsLeftChangedWhereNobodyWantsItKept) {
  const Mesh mesh = furnished_room();
  const Camera camera = room_camera(kWidth, kHeight);
  const GBufferPass g_buffer(mesh, camera, kWidth, kHeight);
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32});
  PassOnMesh keeping = make_pass(mesh, table), careless = make_pass(mesh, table, {.keep_state = false});
  keeping.draw(g_buffer.by_depth(), camera, {.radius = 1.0f});
  const OddState odd;
  const Snapshot before = take_snapshot();
  careless.draw(g_buffer.by_depth(), camera, {.radius = 1.0f});
  EXPECT_THAT(changes_since(before), Not(IsEmpty()));
  EXPECT_EQ(careless.read_masks(), keeping.read_masks());
}

TEST_F(PassState, OfSplatsIsPutBackAndDoesNotMatter) {
  const Mesh mesh = furnished_room();
  const Camera camera = room_camera(kWidth, kHeight);
  const GBufferPass g_buffer(mesh, camera, kWidth, kHeight);
  const GBuffer textures = g_buffer.by_depth(), behind = g_buffer.by_positions();
  const Texture occlusion = make_image(GL_R32F, kWidth, kHeight);
  const std::vector<glm::vec4> spheres{{0.9f, 0.7f, -0.8f, 0.7f}, {-2, 1, -1.5f, 0.4f}};
  const SplatOptions options{.near_radius = 0.3f};
  SplatPass usual;
  usual.set_spheres(spheres);
  usual.draw(textures, camera, options, {occlusion.name()}, &behind);
  const std::vector<glm::vec4> expected = read_image(occlusion.name(), kWidth, kHeight);

  const auto read = [&] {
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    for (const PixelStore& parameter : kKeptPixelStore) glPixelStorei(parameter.name, parameter.tight);
    return read_image(occlusion.name(), kWidth, kHeight);
  };
  {
    const OddState odd;
    const Snapshot before = take_snapshot();
    SplatPass pass({.count_fragments = true});
    pass.set_spheres(spheres);
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after set_spheres";
    pass.draw(textures, camera, options, {occlusion.name()}, &behind);
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after draw";
    EXPECT_GT(pass.read_fragment_count(), 0u);
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after reading";
    EXPECT_THROW(pass.draw(textures, {camera.view, glm::mat4(0)}, options, {occlusion.name()}), std::invalid_argument);
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after an exception";
    EXPECT_EQ(read(), expected);
  }
  const OddState odd;
  const Snapshot before = take_snapshot();
  SplatPass careless({.keep_state = false});
  careless.set_spheres(spheres);
  careless.draw(textures, camera, options, {occlusion.name()}, &behind);
  EXPECT_THAT(changes_since(before), Not(IsEmpty()));
  EXPECT_EQ(read(), expected);
}

TEST_F(PassState, OfVaoIsPutBackAndDoesNotMatter) {
  const Mesh mesh = furnished_room();
  const Camera camera = room_camera(kWidth, kHeight);
  const GBufferPass g_buffer(mesh, camera, kWidth, kHeight);
  const Texture occlusion = make_image(GL_R32F, kWidth, kHeight), bleeding = make_image(GL_RGBA16F, kWidth, kHeight);
  GBuffer textures = g_buffer.by_depth();
  textures.colours = g_buffer.normals();
  const VaoOptions options{.radius = 0.5f, .luminance = LuminanceSensitivity{}};
  const BleedingTarget colours{bleeding.name()};
  const auto read = [&] {
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    for (const PixelStore& parameter : kKeptPixelStore) glPixelStorei(parameter.name, parameter.tight);
    std::vector<glm::vec4> texels = read_image(occlusion.name(), kWidth, kHeight);
    const std::vector<glm::vec4> bled = read_image(bleeding.name(), kWidth, kHeight);
    texels.insert(texels.end(), bled.begin(), bled.end());
    return texels;
  };
  VaoPass().draw(textures, camera, options, {occlusion.name()}, &colours);
  const std::vector<glm::vec4> expected = read();
  for (const bool counts : {false, true}) {
    const OddState odd;
    const Snapshot before = take_snapshot();
    VaoPass pass({.count = counts});
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after it is made";
    pass.draw(textures, camera, options, {occlusion.name()}, &colours);
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after draw";
    if (counts) {
      EXPECT_GT(pass.read_counts().samples, 0u);
    }
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after reading";
    EXPECT_THROW(pass.draw(textures, {camera.view, glm::mat4(0)}, options, {occlusion.name()}), std::invalid_argument);
    EXPECT_THAT(changes_since(before), IsEmpty()) << "after an exception";
    EXPECT_EQ(read(), expected);
  }
  const OddState odd;
  const Snapshot before = take_snapshot();
  VaoPass({.keep_state = false}).draw(textures, camera, options, {occlusion.name()}, &colours);
  EXPECT_THAT(changes_since(before), Not(IsEmpty()));
  EXPECT_EQ(read(), expected);
}

}  // namespace
}  // namespace lkao::gl::tests
