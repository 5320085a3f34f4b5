// OpenGL's state that a pass touches, put back at the end of a scope. gpu/README.md lists it.
#pragma once

#include <epoxy/gl.h>

#include <array>
#include <iterator>
#include <span>
#include <vector>

#include "gpu/gl/state_tables.h"

namespace lkao::gl {

// What a pass touches. Programs and vertex arrays it may always use.
struct StateUse {
  std::span<const GLenum> texture_targets = {};  // of the units from 0 on: the one target that is bound there
  GLuint image_count = 0;                        // units from 0 on, and so below
  GLuint storage_count = 0;
  GLuint block_count = 0;     // uniform buffers
  bool counts = false;        // atomic counter buffer 0
  bool draws = false;         // framebuffers, the whole pipeline, indirect draws
  bool blends = false;        // colours, while drawing
  bool moves_pixels = false;  // between textures and memory or buffers
};

// Then leaves what is used as passes want it: no test, no culling, no blending, masks open, tightly packed pixels.
class StateKeeper {
 public:
  // `keeps` false: nothing is saved, nothing is put back.
  explicit StateKeeper(const StateUse& use, bool keeps = true);
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
  struct ColorState {
    std::array<GLboolean, 4> mask;
    GLboolean is_blended;
    std::array<GLint, std::size(kKeptBlending)> blending;
  };

  void save_textures();
  void save_buffers();
  void save_pixel_moves();
  void save_pipeline();
  void set_defaults() const;
  void restore_textures() const;
  void restore_buffers() const;
  void restore_pixel_moves() const;
  void restore_pipeline() const;

  const StateUse use_;
  const bool keeps_;

  GLint program_ = 0, vertex_array_ = 0;
  GLint active_unit_ = 0;
  std::vector<GLint> textures_, samplers_;
  std::vector<ImageUnit> images_;
  GLint uniform_buffer_ = 0, storage_buffer_ = 0, counter_buffer_ = 0;
  std::vector<IndexedBuffer> blocks_, storage_;
  IndexedBuffer counters_{};
  GLint pack_buffer_ = 0, unpack_buffer_ = 0;
  std::vector<GLint> pixel_store_;

  GLint draw_framebuffer_ = 0, read_framebuffer_ = 0, indirect_buffer_ = 0;
  std::vector<GLboolean> capabilities_;
  std::vector<ColorState> colors_;
  GLboolean has_scissor_ = GL_FALSE, depth_mask_ = GL_TRUE;
  std::array<GLfloat, 4> viewport_{};
  std::array<GLdouble, 2> depth_range_{};
  GLint depth_function_ = 0, cull_mode_ = 0, front_face_ = 0, logic_operation_ = 0, clip_origin_ = 0, clip_depth_ = 0;
  std::array<GLint, 2> polygon_mode_{};
};

}  // namespace lkao::gl
