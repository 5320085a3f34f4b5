#include "gpu/unbounded_radius.h"

#include <cstddef>

#include "gpu/pass_uniforms.h"
#include "gpu/shaders/constants.h"

namespace lkao::gl {
namespace {

// The buffer of extent.glsl.
struct Extent {
  GLuint sides[12];
  float radius, depth;
};

constexpr GLintptr kClipDepth = offsetof(PassUniforms, clip_from_world) + (3 * 4 + 2) * sizeof(float);

}  // namespace

UnboundedRadius::UnboundedRadius()
    : extent_(make_buffer(sizeof(Extent), nullptr, GL_DYNAMIC_STORAGE_BIT)), program_(make_program({"radius.comp"})) {}

void UnboundedRadius::begin() const {
  const Extent nothing{};
  glNamedBufferSubData(extent_.name(), 0, sizeof(nothing), &nothing);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LKAO_STORAGE_EXTENT, extent_.name());
}

void UnboundedRadius::put_into(GLuint uniform_buffer, bool is_perspective) const {
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  glUseProgram(program_.name());
  glDispatchCompute(1, 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  const auto copy = [&](std::size_t from, GLintptr to) {
    glCopyNamedBufferSubData(extent_.name(), uniform_buffer, static_cast<GLintptr>(from), to, sizeof(float));
  };
  copy(offsetof(Extent, radius), offsetof(PassUniforms, lengths));
  if (!is_perspective) return;  // its depths hang on the camera's planes
  copy(offsetof(Extent, depth), offsetof(PassUniforms, depth_map));
  copy(offsetof(Extent, depth), kClipDepth);
}

}  // namespace lkao::gl
