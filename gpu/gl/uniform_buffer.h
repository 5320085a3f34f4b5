// A uniform block's buffer.
#pragma once

#include "gpu/gl/objects.h"

namespace lkao::gl {

// Of a block as gpu/gl/block.h makes them.
template <typename Block>
class UniformBuffer {
 public:
  UniformBuffer() : buffer_(make_buffer(sizeof(Block), nullptr, GL_DYNAMIC_STORAGE_BIT)) {}

  GLuint name() const { return buffer_.name(); }
  void set_and_bind(const Block& block) const {
    glNamedBufferSubData(buffer_.name(), 0, sizeof(Block), &block);
    glBindBufferBase(GL_UNIFORM_BUFFER, Block::kBinding, buffer_.name());
  }

 private:
  Buffer buffer_;
};

}  // namespace lkao::gl
