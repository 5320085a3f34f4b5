#include "gpu/gl_state.h"

#include <initializer_list>

#include "gpu/g_buffer_pass.h"
#include "gpu/gl/state_keeper.h"

namespace lkao::gl::tests {
namespace {

using Enums = std::initializer_list<GLenum>;

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

}  // namespace

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

std::vector<std::string> changes_since(const Snapshot& before) {
  std::vector<std::string> names;
  for (const auto& [name, values] : take_snapshot()) {
    if (values != before.at(name)) names.push_back(name);
  }
  return names;
}

OddState::OddState()
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

OddState::~OddState() {
  // The next test gets the context's defaults: it has a context of its own.
  glUseProgram(0);
}

void OddState::bind() const {
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

void OddState::set_pipeline() {
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

}  // namespace lkao::gl::tests
