// What the examples' renderers need of OpenGL.
#pragma once

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace examples {

inline GLuint compile(GLenum stage, const char* text) {
  const GLuint shader = glCreateShader(stage);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  return shader;
}

// Throws std::runtime_error where the driver refuses a shader.
inline GLuint link(const char* vertex_shader, const char* fragment_shader) {
  const GLuint program = glCreateProgram();
  for (const GLuint shader : {compile(GL_VERTEX_SHADER, vertex_shader), compile(GL_FRAGMENT_SHADER, fragment_shader)}) {
    glAttachShader(program, shader);
    glDeleteShader(shader);
  }
  glLinkProgram(program);
  GLint is_linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &is_linked);
  if (is_linked != GL_TRUE) throw std::runtime_error("the driver refuses a shader of the renderer");
  return program;
}

inline GLuint make_texture(GLenum format, int width, int height) {
  GLuint texture = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &texture);
  glTextureStorage2D(texture, 1, format, width, height);
  // Without mipmaps it would not be complete otherwise.
  glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  return texture;
}

// OpenGL's rows begin at the bottom, those of images at the top. `row_size` divides the size of `values`.
template <typename Value>
std::vector<Value> upside_down(const std::vector<Value>& values, std::size_t row_size) {
  std::vector<Value> turned;
  turned.reserve(values.size());
  for (std::size_t row = values.size() / row_size; row-- > 0;) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(row * row_size);
    turned.insert(turned.end(), first, first + static_cast<std::ptrdiff_t>(row_size));
  }
  return turned;
}

}  // namespace examples
