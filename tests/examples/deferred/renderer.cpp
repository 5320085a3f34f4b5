#include "renderer.h"

#include <epoxy/gl.h>

#include <cmath>
#include <stdexcept>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "examples/gl_objects.h"

namespace deferred {
namespace {

using examples::make_texture;

constexpr float kNear = 0.1f, kFar = 50;
// Where a picture lies that is a part of larger textures, and what they have beyond it.
constexpr int kPartX = 37, kPartY = 21;

constexpr const char* kVertexShader = R"(#version 450 core
layout(location = 0) uniform mat4 view;
layout(location = 1) uniform mat4 projection;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
out vec3 world_position, view_position, world_normal, view_normal;
void main() {
  vec3 to_eye = inverse(view)[3].xyz - position;
  world_position = position;
  world_normal = dot(normal, to_eye) < 0 ? -normal : normal;
  view_position = (view * vec4(position, 1)).xyz;
  view_normal = mat3(view) * world_normal;
  gl_Position = projection * vec4(view_position, 1);
})";

// The numbers are those of Place, PositionSpace, NormalSpace and NormalEncoding.
constexpr const char* kFragmentShader = R"(#version 450 core
layout(location = 2) uniform int place;
layout(location = 3) uniform int is_view_position;
layout(location = 4) uniform int is_view_normal;
layout(location = 5) uniform int is_octahedral;
layout(location = 6) uniform int is_unsigned;
in vec3 world_position, view_position, world_normal, view_normal;
layout(location = 0) out vec4 place_out;
layout(location = 1) out vec4 normal_out;
void main() {
  vec3 position = is_view_position != 0 ? view_position : world_position;
  place_out = place == 1 ? vec4(-view_position.z, 0, 0, 0) : vec4(position, 1);
  vec3 n = normalize(is_view_normal != 0 ? view_normal : world_normal);
  if (is_octahedral != 0) {
    n /= abs(n.x) + abs(n.y) + abs(n.z);
    if (n.z < 0) n.xy = (1 - abs(n.yx)) * vec2(n.x < 0 ? -1 : 1, n.y < 0 ? -1 : 1);
  }
  normal_out = vec4(is_unsigned != 0 ? 0.5 * n + 0.5 : n, 0);
})";

struct Vertex {
  glm::vec3 position, normal;
};

// Each triangle with vertices of its own, as models with hard edges have them.
std::vector<Vertex> separate_triangles(const lkao::scene::Mesh& mesh) {
  std::vector<Vertex> vertices;
  for (const glm::uvec3& triangle : mesh.triangles) {
    const glm::vec3 &a = mesh.positions[triangle.x], &b = mesh.positions[triangle.y], &c = mesh.positions[triangle.z];
    const glm::dvec3 area = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
    const glm::vec3 normal = area == glm::dvec3(0) ? glm::vec3(0) : glm::vec3(glm::normalize(area));
    for (const glm::vec3& position : {a, b, c}) vertices.push_back({position, normal});
  }
  return vertices;
}

bool is_unsigned(GLenum format) { return format == GL_RGB10_A2 || format == GL_RG16 || format == GL_RG8; }

glm::mat4 projection_of(const Kind& kind, float horizontal_scale, float aspect) {
  const float vertical_angle = 2 * std::atan(1 / (horizontal_scale * aspect));
  glm::mat4 projection = glm::perspectiveRH_NO(vertical_angle, aspect, kNear, kFar);
  if (kind.is_reversed) {
    projection[2][2] = 0;
    projection[3][2] = kNear;
  }
  return projection;
}

}  // namespace

Renderer::Renderer(const lkao::scene::Mesh& mesh, const lkao::scene::Camera& camera, int width, int height)
    : width_(width),
      height_(height),
      view_(glm::lookAt(camera.eye, camera.target, camera.up)),
      horizontal_scale_(1 / std::tan(0.5f * glm::radians(camera.fov))) {
  const std::vector<Vertex> vertices = separate_triangles(mesh);
  vertex_count_ = static_cast<int>(vertices.size());
  glCreateBuffers(1, &vertices_);
  glNamedBufferStorage(vertices_, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)), vertices.data(), 0);
  glCreateVertexArrays(1, &vertex_array_);
  glVertexArrayVertexBuffer(vertex_array_, 0, vertices_, 0, sizeof(Vertex));
  for (GLuint attribute = 0; attribute < 2; ++attribute) {
    glVertexArrayAttribFormat(vertex_array_, attribute, 3, GL_FLOAT, GL_FALSE, attribute * sizeof(glm::vec3));
    glVertexArrayAttribBinding(vertex_array_, attribute, 0);
    glEnableVertexArrayAttrib(vertex_array_, attribute);
  }
  program_ = examples::link(kVertexShader, kFragmentShader);
  glCreateFramebuffers(1, &framebuffer_);
  occlusion_ = make_texture(GL_R32F, width, height);
  half_occlusion_ = make_texture(GL_R32F, (width + 1) / 2, (height + 1) / 2);
}

Renderer::~Renderer() {
  delete_textures();
  for (const GLuint texture : {occlusion_, half_occlusion_}) glDeleteTextures(1, &texture);
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteProgram(program_);
  glDeleteVertexArrays(1, &vertex_array_);
  glDeleteBuffers(1, &vertices_);
}

void Renderer::delete_textures() {
  for (const GLuint texture : {place_, depth_, normals_}) glDeleteTextures(1, &texture);
}

void Renderer::make_textures() {
  delete_textures();
  const bool has_depth = kind_.place == Place::depth;
  const int width = width_ + (kind_.is_part ? 2 * kPartX : 0), height = height_ + (kind_.is_part ? 2 * kPartY : 0);
  depth_ = make_texture(has_depth ? kind_.place_format : GL_DEPTH_COMPONENT24, width, height);
  place_ = has_depth ? 0 : make_texture(kind_.place_format, width, height);
  normals_ = make_texture(kind_.normal_format, width, height);
  glNamedFramebufferTexture(framebuffer_, GL_DEPTH_ATTACHMENT, depth_, 0);
  glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, place_, 0);
  glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT1, normals_, 0);
  const GLenum attachments[] = {has_depth ? GLenum{GL_NONE} : GLenum{GL_COLOR_ATTACHMENT0}, GL_COLOR_ATTACHMENT1};
  glNamedFramebufferDrawBuffers(framebuffer_, 2, attachments);
}

void Renderer::draw_g_buffer(const Kind& kind) {
  kind_ = kind;
  make_textures();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(kind.is_part ? kPartX : 0, kind.is_part ? kPartY : 0, width_, height_);
  glDepthMask(GL_TRUE);
  const float zeros[4] = {}, depth = kind.is_reversed ? 0.0f : 1.0f;
  for (int i = 0; i < 2; ++i) glClearNamedFramebufferfv(framebuffer_, GL_COLOR, i, zeros);
  glClearNamedFramebufferfv(framebuffer_, GL_DEPTH, 0, &depth);
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDepthFunc(kind.is_reversed ? GL_GREATER : GL_LESS);
  glClipControl(GL_LOWER_LEFT, kind.is_reversed ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
  glUseProgram(program_);
  const lkao::gl::Camera seen = camera();
  glUniformMatrix4fv(0, 1, GL_FALSE, glm::value_ptr(seen.view));
  glUniformMatrix4fv(1, 1, GL_FALSE, glm::value_ptr(seen.projection));
  glUniform1i(2, static_cast<int>(kind.place));
  glUniform1i(3, kind.position_space == lkao::gl::PositionSpace::view);
  glUniform1i(4, kind.normal_space == lkao::gl::NormalSpace::view);
  glUniform1i(5, kind.normal_encoding == lkao::gl::NormalEncoding::octahedral);
  glUniform1i(6, is_unsigned(kind.normal_format));
  glBindVertexArray(vertex_array_);
  glDrawArrays(GL_TRIANGLES, 0, vertex_count_);
  glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
}

lkao::gl::GBuffer Renderer::g_buffer() const {
  lkao::gl::GBuffer g_buffer{.width = width_, .height = height_, .normals = normals_};
  if (kind_.place == Place::depth) g_buffer.depth = depth_;
  if (kind_.place == Place::linear_depth) g_buffer.linear_depth = place_;
  if (kind_.place == Place::positions) g_buffer.positions = place_;
  g_buffer.position_space = kind_.position_space;
  g_buffer.normal_space = kind_.normal_space;
  g_buffer.normal_encoding = kind_.normal_encoding;
  if (kind_.is_part) g_buffer.part = lkao::gl::Part{kPartX, kPartY};
  g_buffer.step = kind_.step;
  return g_buffer;
}

lkao::gl::Camera Renderer::camera() const {
  const float aspect = static_cast<float>(width_) / static_cast<float>(height_);
  return {view_, projection_of(kind_, horizontal_scale_, aspect),
          kind_.is_reversed ? lkao::gl::ClipDepth::zero_to_one : lkao::gl::ClipDepth::minus_one_to_one};
}

std::vector<float> Renderer::read_occlusion() const {
  std::vector<float> pixels(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  glGetTextureImage(occlusion_, 0, GL_RED, GL_FLOAT, static_cast<GLsizei>(pixels.size() * sizeof(float)),
                    pixels.data());
  return pixels;
}

}  // namespace deferred
