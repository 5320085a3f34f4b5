#include "gpu/mesh/unbounded_radius.h"

#include <cstddef>

#include "gpu/mesh/shapes_block.h"
#include "gpu/mesh/units.h"

namespace lkao::gl {
namespace {

// The buffer of extent.glsl.
struct Extent {
  GLuint sides[12];
  float radius, depth_scale;
};

constexpr GLintptr kClipDepth = offsetof(ShapesBlock, clip_from_world) + (3 * 4 + 2) * sizeof(float);

}  // namespace

UnboundedRadius::UnboundedRadius()
    : extent_(make_buffer(sizeof(Extent), nullptr, GL_DYNAMIC_STORAGE_BIT)),
      program_(make_program({"mesh/radius.comp"})) {}

void UnboundedRadius::begin() const {
  const Extent nothing{};
  glNamedBufferSubData(extent_.name(), 0, sizeof(nothing), &nothing);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LKAO_STORAGE_EXTENT, extent_.name());
}

void UnboundedRadius::put_into(GLuint shapes_buffer, bool is_perspective) const {
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  glUseProgram(program_.name());
  glDispatchCompute(1, 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  const auto copy = [&](std::size_t from, GLintptr to) {
    glCopyNamedBufferSubData(extent_.name(), shapes_buffer, static_cast<GLintptr>(from), to, sizeof(float));
  };
  copy(offsetof(Extent, radius), offsetof(ShapesBlock, radius));
  if (!is_perspective) return;  // its depths depend on the camera's planes
  copy(offsetof(Extent, depth_scale), offsetof(ShapesBlock, depth_scale));
  copy(offsetof(Extent, depth_scale), kClipDepth);
}

}  // namespace lkao::gl
