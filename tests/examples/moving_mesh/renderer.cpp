#include "renderer.h"

#include <epoxy/gl.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "examples/gl_objects.h"

namespace moving_mesh {
namespace {

using examples::link;
using examples::make_texture;

constexpr const char* kMeshVertexShader = R"(#version 450 core
layout(location = 0) uniform mat4 clip_from_world;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 color;
out vec3 world_normal, linear_color;
void main() {
  world_normal = normal;
  linear_color = color;
  gl_Position = clip_from_world * vec4(position, 1);
})";

constexpr const char* kMeshFragmentShader = R"(#version 450 core
in vec3 world_normal, linear_color;
layout(location = 0) out vec4 normal_out;
layout(location = 1) out vec4 color_out;
void main() {
  // Both sides of the cloth are seen.
  normal_out = vec4(normalize(gl_FrontFacing ? world_normal : -world_normal), 0);
  color_out = vec4(linear_color, 1);
})";

constexpr const char* kScreenVertexShader = R"(#version 450 core
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); })";

constexpr const char* kShadeFragmentShader = R"(#version 450 core
layout(binding = 0) uniform sampler2D depth;
layout(binding = 1) uniform sampler2D normals;
layout(binding = 2) uniform sampler2D colors;
layout(binding = 3) uniform sampler2D occlusion;
layout(location = 0) out vec4 picture;
const vec3 sky = vec3(0.9, 0.95, 1.0), ground = vec3(0.55, 0.5, 0.45);
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 light = mix(ground, sky, 0.5 * texelFetch(normals, pixel, 0).y + 0.5);
  float visibility = 1.0 - texelFetch(occlusion, pixel, 0).x;
  bool shows_something = texelFetch(depth, pixel, 0).x > 0.0;
  vec3 radiance = shows_something ? visibility * light * texelFetch(colors, pixel, 0).xyz : 0.8 * sky;
  picture = vec4(pow(radiance, vec3(1.0 / 2.2)), 1);
})";

template <typename Value>
GLuint make_buffer(std::span<const Value> values) {
  GLuint buffer = 0;
  glCreateBuffers(1, &buffer);
  glNamedBufferStorage(buffer, static_cast<GLsizeiptr>(values.size_bytes()), values.data(), 0);
  return buffer;
}

// For a vec3 a vertex that changes every frame.
GLuint make_stream(std::size_t vertex_count) {
  GLuint buffer = 0;
  glCreateBuffers(1, &buffer);
  glNamedBufferStorage(buffer, static_cast<GLsizeiptr>(vertex_count * sizeof(glm::vec3)), nullptr,
                       GL_DYNAMIC_STORAGE_BIT);
  return buffer;
}

void upload(GLuint buffer, std::span<const glm::vec3> values) {
  glNamedBufferSubData(buffer, 0, static_cast<GLsizeiptr>(values.size_bytes()), values.data());
}

glm::mat4 infinite_reversed_projection(float vertical_angle, float aspect, float near) {
  const float scale = 1 / std::tan(vertical_angle / 2);
  glm::mat4 projection(0);
  projection[0][0] = scale / aspect;
  projection[1][1] = scale;
  projection[2][3] = -1;
  projection[3][2] = near;
  return projection;
}

}  // namespace

Renderer::Renderer(int width, int height, std::span<const glm::uvec3> triangles, std::span<const glm::vec3> colors)
    : width_(width),
      height_(height),
      index_count_(static_cast<int>(3 * triangles.size())),
      view_(glm::lookAt(glm::vec3(0, 1.7f, 4.6f), glm::vec3(0, 1.1f, -1), glm::vec3(0, 1, 0))),
      projection_(infinite_reversed_projection(0.8f, static_cast<float>(width) / static_cast<float>(height), 0.05f)) {
  depth_ = make_texture(GL_DEPTH_COMPONENT32F, width, height);
  normals_ = make_texture(GL_RGBA16F, width, height);
  colors_ = make_texture(GL_RGBA8, width, height);
  occlusion_ = make_texture(GL_R8, width, height);
  picture_ = make_texture(GL_RGBA8, width, height);

  glCreateFramebuffers(1, &g_buffer_);
  glNamedFramebufferTexture(g_buffer_, GL_DEPTH_ATTACHMENT, depth_, 0);
  glNamedFramebufferTexture(g_buffer_, GL_COLOR_ATTACHMENT0, normals_, 0);
  glNamedFramebufferTexture(g_buffer_, GL_COLOR_ATTACHMENT1, colors_, 0);
  const GLenum attachments[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  glNamedFramebufferDrawBuffers(g_buffer_, 2, attachments);
  glCreateFramebuffers(1, &target_);
  glNamedFramebufferTexture(target_, GL_COLOR_ATTACHMENT0, picture_, 0);

  position_buffer_ = make_stream(colors.size());
  normal_buffer_ = make_stream(colors.size());
  color_buffer_ = make_buffer(colors);
  index_buffer_ = make_buffer(triangles);
  glCreateVertexArrays(1, &no_attributes_);
  glCreateVertexArrays(1, &vertex_array_);
  glVertexArrayElementBuffer(vertex_array_, index_buffer_);
  GLuint attribute = 0;
  for (const GLuint buffer : {position_buffer_, normal_buffer_, color_buffer_}) {
    glVertexArrayVertexBuffer(vertex_array_, attribute, buffer, 0, sizeof(glm::vec3));
    glVertexArrayAttribFormat(vertex_array_, attribute, 3, GL_FLOAT, GL_FALSE, 0);
    glEnableVertexArrayAttrib(vertex_array_, attribute);
    ++attribute;
  }
  mesh_program_ = link(kMeshVertexShader, kMeshFragmentShader);
  shade_program_ = link(kScreenVertexShader, kShadeFragmentShader);
}

Renderer::~Renderer() {
  for (const GLuint program : {mesh_program_, shade_program_}) glDeleteProgram(program);
  for (const GLuint array : {vertex_array_, no_attributes_}) glDeleteVertexArrays(1, &array);
  for (const GLuint buffer : {position_buffer_, normal_buffer_, color_buffer_, index_buffer_}) {
    glDeleteBuffers(1, &buffer);
  }
  for (const GLuint framebuffer : {g_buffer_, target_}) glDeleteFramebuffers(1, &framebuffer);
  for (const GLuint texture : {depth_, normals_, colors_, occlusion_, picture_}) glDeleteTextures(1, &texture);
}

void Renderer::draw_g_buffer(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals) {
  upload(position_buffer_, positions);
  upload(normal_buffer_, normals);
  glBindFramebuffer(GL_FRAMEBUFFER, g_buffer_);
  glViewport(0, 0, width_, height_);
  const float zeros[4] = {0, 0, 0, 0};
  for (int i = 0; i < 2; ++i) glClearBufferfv(GL_COLOR, i, zeros);
  glClearBufferfv(GL_DEPTH, 0, zeros);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glUseProgram(mesh_program_);
  glBindVertexArray(vertex_array_);
  const glm::mat4 clip_from_world = projection_ * view_;
  glUniformMatrix4fv(0, 1, GL_FALSE, glm::value_ptr(clip_from_world));
  glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
}

void Renderer::shade() {
  glBindFramebuffer(GL_FRAMEBUFFER, target_);
  glViewport(0, 0, width_, height_);
  glDisable(GL_DEPTH_TEST);
  GLuint unit = 0;
  for (const GLuint texture : {depth_, normals_, colors_, occlusion_}) glBindTextureUnit(unit++, texture);
  glUseProgram(shade_program_);
  glBindVertexArray(no_attributes_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

std::vector<std::uint8_t> Renderer::read_picture() const {
  const std::size_t row_size = 3 * static_cast<std::size_t>(width_);
  std::vector<std::uint8_t> from_bottom(row_size * static_cast<std::size_t>(height_));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTextureImage(picture_, 0, GL_RGB, GL_UNSIGNED_BYTE, static_cast<GLsizei>(from_bottom.size()),
                    from_bottom.data());
  return examples::upside_down(from_bottom, row_size);
}

std::vector<std::uint8_t> Renderer::read_occlusion() const {
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTextureImage(occlusion_, 0, GL_RED, GL_UNSIGNED_BYTE, static_cast<GLsizei>(pixels.size()), pixels.data());
  return pixels;
}

}  // namespace moving_mesh
