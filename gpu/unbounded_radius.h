// The finite AO radius that stands for an infinite one: beyond all occluders, as seen from all receivers of a frame.
#pragma once

#include "gpu/gl_objects.h"
#include "gpu/program.h"

namespace lkao::gl {

// Found on the GPU, since only the GPU knows where moved meshes and the pixels of depth buffers are.
class UnboundedRadius {
 public:
  UnboundedRadius();

  // Before "classify.comp" and "receivers.comp", which note with LKAO_FLAG_UNBOUNDED where occluders and receivers are.
  void begin() const;
  // After them: puts the radius into a buffer of PassUniforms, and what hangs on it.
  void put_into(GLuint uniform_buffer, bool is_perspective) const;

 private:
  Buffer extent_;
  ProgramObject program_;
};

}  // namespace lkao::gl
