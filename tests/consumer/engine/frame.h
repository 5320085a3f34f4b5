// A frame of an engine: every pixel shows the foot of the same wall.
#pragma once

#include <epoxy/gl.h>
#include <lkao/gl.h>

#include <array>
#include <vector>

inline constexpr int kSize = 16;

struct Frame {
  // The floor lies at y = 0, the wall stands on it at z = 0.
  std::array<glm::vec3, 8> positions{
      {{-5, 0, -5}, {5, 0, -5}, {5, 0, 5}, {-5, 0, 5}, {-5, 0, 0}, {5, 0, 0}, {5, 5, 0}, {-5, 5, 0}}};
  std::array<glm::uvec3, 4> triangles{{{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}}};
  lkao::gl::GBuffer g_buffer;
  lkao::gl::Camera camera{.view = glm::mat4(1), .projection = glm::mat4(1)};
  GLuint target = 0;
};

// A texture of the G-buffer, the same in every pixel.
inline GLuint make_texture(const std::array<float, 4>& value) {
  GLuint texture = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &texture);
  glTextureStorage2D(texture, 1, GL_RGBA32F, kSize, kSize);
  glClearTexImage(texture, 0, GL_RGBA, GL_FLOAT, value.data());
  return texture;
}

inline Frame make_frame() {
  Frame frame;
  frame.g_buffer = {.width = kSize,
                    .height = kSize,
                    .positions = make_texture({0, 0, 0.001f, 1}),
                    .normals = make_texture({0, 1, 0, 0})};
  glCreateTextures(GL_TEXTURE_2D, 1, &frame.target);
  glTextureStorage2D(frame.target, 1, GL_R32F, kSize, kSize);
  return frame;
}

inline float mean_of(const Frame& frame) {
  std::vector<float> pixels(std::size_t{kSize} * kSize);
  glGetTextureImage(frame.target, 0, GL_RED, GL_FLOAT, static_cast<GLsizei>(pixels.size() * sizeof(float)),
                    pixels.data());
  float sum = 0;
  for (const float pixel : pixels) sum += pixel;
  return sum / static_cast<float>(pixels.size());
}
