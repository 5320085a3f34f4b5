// Owners of OpenGL objects: deleted with their owner, in the context that is current then. Where there is none, it has
// taken them with it.
#pragma once

#include <epoxy/gl.h>

#include <utility>

#include "gpu/gl/error.h"

namespace lkao::gl {

template <typename Kind>
class Object {
 public:
  Object() = default;
  explicit Object(GLuint name) : name_(name) {}
  ~Object() { reset(); }
  Object(Object&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Object& operator=(Object&& other) noexcept {
    if (this != &other) {
      reset();
      name_ = std::exchange(other.name_, 0);
    }
    return *this;
  }
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;

  // 0 where there is none.
  GLuint name() const { return name_; }
  explicit operator bool() const { return name_ != 0; }
  void reset() {
    if (name_ != 0 && has_context()) Kind::destroy(name_);
    name_ = 0;
  }

 private:
  GLuint name_ = 0;
};

struct BufferKind {
  static void destroy(GLuint name) { glDeleteBuffers(1, &name); }
};
struct TextureKind {
  static void destroy(GLuint name) { glDeleteTextures(1, &name); }
};
struct SamplerKind {
  static void destroy(GLuint name) { glDeleteSamplers(1, &name); }
};
struct FramebufferKind {
  static void destroy(GLuint name) { glDeleteFramebuffers(1, &name); }
};
struct VertexArrayKind {
  static void destroy(GLuint name) { glDeleteVertexArrays(1, &name); }
};
struct QueryKind {
  static void destroy(GLuint name) { glDeleteQueries(1, &name); }
};
struct ProgramKind {
  static void destroy(GLuint name) { glDeleteProgram(name); }
};
struct ShaderKind {
  static void destroy(GLuint name) { glDeleteShader(name); }
};

using Buffer = Object<BufferKind>;
using Texture = Object<TextureKind>;
using Sampler = Object<SamplerKind>;
using Framebuffer = Object<FramebufferKind>;
using VertexArray = Object<VertexArrayKind>;
using Query = Object<QueryKind>;
using ProgramObject = Object<ProgramKind>;
using ShaderObject = Object<ShaderKind>;

// Of at least one byte: a buffer without storage cannot be bound.
inline Buffer make_buffer(GLsizeiptr size, const void* data, GLbitfield flags) {
  GLuint name = 0;
  glCreateBuffers(1, &name);
  glNamedBufferStorage(name, size > 0 ? size : 16, size > 0 ? data : nullptr, flags);
  return Buffer(name);
}

inline Texture make_texture(GLenum target) {
  GLuint name = 0;
  glCreateTextures(target, 1, &name);
  return Texture(name);
}

// Reads texels as they are, whatever filter or comparison a texture has of its own.
inline Sampler make_plain_sampler() {
  GLuint name = 0;
  glCreateSamplers(1, &name);
  glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return Sampler(name);
}

// A view of a buffer that shaders read as a texture.
inline Texture make_buffer_texture(GLenum format, const Buffer& buffer) {
  Texture texture = make_texture(GL_TEXTURE_BUFFER);
  glTextureBuffer(texture.name(), format, buffer.name());
  return texture;
}

inline Framebuffer make_framebuffer() {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  return Framebuffer(name);
}

inline VertexArray make_vertex_array() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return VertexArray(name);
}

inline Query make_query(GLenum target) {
  GLuint name = 0;
  glCreateQueries(target, 1, &name);
  return Query(name);
}

}  // namespace lkao::gl
