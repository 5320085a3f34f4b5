// Everything of OpenGL's state that the passes touch, put back at the end of a scope. gpu/README.md lists it.
#pragma once

#include <epoxy/gl.h>

#include <array>
#include <vector>

#include "gpu/shaders/constants.h"

namespace lkao::gl {

// Then leaves everything as the passes want it: no test, no culling, masks open, tightly packed pixels.
class StateKeeper {
 public:
  StateKeeper();
  ~StateKeeper();
  StateKeeper(const StateKeeper&) = delete;
  StateKeeper& operator=(const StateKeeper&) = delete;

 private:
  struct IndexedBuffer {
    GLint name;
    GLint64 start, size;
  };
  struct ImageUnit {
    GLint name, level, is_layered, layer, access, format;
  };

  void save_bindings();
  void save_pipeline();
  void set_defaults();
  void restore_bindings() const;
  void restore_pipeline() const;

  static IndexedBuffer indexed_buffer(GLenum binding, GLenum start, GLenum size, GLuint index);
  static void restore(GLenum target, GLuint index, const IndexedBuffer& buffer);

  GLint program_ = 0, vertex_array_ = 0, draw_framebuffer_ = 0, read_framebuffer_ = 0, active_unit_ = 0;
  std::array<GLint, LKAO_UNIT_COUNT> textures_{}, samplers_{};
  GLint uniform_buffer_ = 0, storage_buffer_ = 0, counter_buffer_ = 0, indirect_buffer_ = 0;
  GLint pack_buffer_ = 0, unpack_buffer_ = 0;
  IndexedBuffer uniforms_{}, counters_{};
  std::array<IndexedBuffer, LKAO_STORAGE_COUNT> storage_{};
  std::array<ImageUnit, 2> images_{};
  std::vector<GLint> pixel_store_;

  std::vector<GLboolean> capabilities_;
  GLboolean has_scissor_ = GL_FALSE, depth_mask_ = GL_TRUE;
  std::array<GLfloat, 4> viewport_{};
  std::array<GLdouble, 2> depth_range_{};
  std::array<std::array<GLboolean, 4>, 8> color_masks_{};
  GLint depth_function_ = 0, cull_mode_ = 0, front_face_ = 0, logic_operation_ = 0, clip_origin_ = 0, clip_depth_ = 0;
  std::array<GLint, 2> polygon_mode_{};
};

}  // namespace lkao::gl
