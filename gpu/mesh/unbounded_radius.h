// The finite AO radius that stands for an infinite one: beyond all occluders, as seen from all receivers of a frame.
#pragma once

#include "gpu/gl/objects.h"
#include "gpu/gl/program.h"

namespace lkao::gl {

// Found on the GPU, since only the GPU knows where moved meshes and the pixels of depth buffers are.
class UnboundedRadius {
 public:
  UnboundedRadius();

  // Before "mesh/classify.comp" and what finds receivers, which note where occluders and receivers are.
  void begin() const;
  // After them: puts the radius into a buffer of ShapesBlock, and what depends on it.
  void put_into(GLuint shapes_buffer, bool is_perspective) const;

 private:
  Buffer extent_;
  ProgramObject program_;
};

}  // namespace lkao::gl
