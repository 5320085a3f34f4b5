#include "gpu/g_buffer_pass.h"

#include <cstddef>

#include <glm/gtc/type_ptr.hpp>

#include "gpu/gl/program.h"

namespace lkao::gl::tests {
namespace {

constexpr const char* kVertexShader = R"(#version 450 core
  layout(location = 0) uniform mat4 clip_from_world;
  layout(std430, binding = 0) readonly buffer Positions { float positions[]; };
  layout(std430, binding = 1) readonly buffer Triangles { uint triangles[]; };
  layout(location = 2) uniform mat4 view;
  out vec3 place, view_place;
  flat out vec3 normal;
  vec3 corner(int i) {
    uint vertex = triangles[i];
    return vec3(positions[3u * vertex], positions[3u * vertex + 1u], positions[3u * vertex + 2u]);
  }
  void main() {
    int first = gl_VertexID / 3 * 3;
    place = corner(gl_VertexID);
    normal = cross(corner(first + 1) - corner(first), corner(first + 2) - corner(first));
    view_place = (view * vec4(place, 1)).xyz;
    gl_Position = clip_from_world * vec4(place, 1);
  })";

constexpr const char* kFragmentShader = R"(#version 450 core
  layout(location = 1) uniform vec4 eye;  // w = 0: the direction of view
  layout(location = 2) uniform mat4 view;
  in vec3 place, view_place;
  flat in vec3 normal;
  layout(location = 0) out vec4 position_out;
  layout(location = 1) out vec4 normal_out;
  layout(location = 2) out float linear_depth_out;
  layout(location = 3) out float face_out;
  layout(location = 4) out vec4 view_position_out;
  void main() {
    vec3 seen_along = eye.w == 0.0 ? eye.xyz : place - eye.xyz;
    position_out = vec4(place, 1);
    view_position_out = vec4(view_place, 1);
    normal_out = vec4(dot(seen_along, normal) > 0.0 ? -normal : normal, 0);
    linear_depth_out = -(view * vec4(place, 1)).z;
    face_out = float(gl_PrimitiveID + 1);
  })";

ProgramObject make_g_buffer_program() {
  ProgramObject program(glCreateProgram());
  for (const auto& [stage, text] :
       {std::pair{GL_VERTEX_SHADER, kVertexShader}, {GL_FRAGMENT_SHADER, kFragmentShader}}) {
    const ShaderObject shader(glCreateShader(static_cast<GLenum>(stage)));
    glShaderSource(shader.name(), 1, &text, nullptr);
    glCompileShader(shader.name());
    glAttachShader(program.name(), shader.name());
  }
  glLinkProgram(program.name());
  return program;
}

bool is_perspective(const Camera& camera) { return camera.projection[2][3] != 0; }
// Normalised device depth grows with the distance.
bool is_reversed(const Camera& camera) {
  return is_perspective(camera) ? camera.projection[3][2] > 0 : camera.projection[2][2] > 0;
}

glm::vec4 eye_of(const Camera& camera) {
  const glm::mat4 world_from_view = glm::inverse(camera.view);
  return is_perspective(camera) ? glm::vec4(glm::vec3(world_from_view[3]), 1) : -world_from_view[2];
}

}  // namespace

Texture make_image(GLenum format, int width, int height, const float* rgba) {
  Texture texture = make_texture(GL_TEXTURE_2D);
  glTextureStorage2D(texture.name(), 1, format, width, height);
  if (rgba != nullptr) glTextureSubImage2D(texture.name(), 0, 0, 0, width, height, GL_RGBA, GL_FLOAT, rgba);
  return texture;
}

std::vector<glm::vec4> read_image(GLuint texture, int width, int height) {
  std::vector<glm::vec4> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  glGetTextureImage(texture, 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(pixels.size() * sizeof(glm::vec4)),
                    pixels.data());
  return pixels;
}

GBufferPass::GBufferPass(const Mesh& mesh, const Camera& camera, int width, int height, const GBufferFormats& formats)
    : width_(width),
      height_(height),
      depth_(make_image(formats.depth, width, height)),
      linear_depth_(make_image(formats.linear_depth, width, height)),
      positions_(make_image(formats.positions, width, height)),
      view_positions_(make_image(formats.positions, width, height)),
      normals_(make_image(formats.normals, width, height)),
      faces_(make_image(GL_R32F, width, height)) {
  const Framebuffer framebuffer = make_framebuffer();
  glNamedFramebufferTexture(framebuffer.name(), GL_DEPTH_ATTACHMENT, depth_.name(), 0);
  glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, positions_.name(), 0);
  glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT1, normals_.name(), 0);
  glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT2, linear_depth_.name(), 0);
  glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT3, faces_.name(), 0);
  glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT4, view_positions_.name(), 0);
  const GLenum attachments[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2, GL_COLOR_ATTACHMENT3,
                                GL_COLOR_ATTACHMENT4};
  glNamedFramebufferDrawBuffers(framebuffer.name(), 5, attachments);
  const Buffer positions = make_buffer(static_cast<GLsizeiptr>(mesh.positions.size() * 12), mesh.positions.data(), 0);
  const Buffer triangles = make_buffer(static_cast<GLsizeiptr>(mesh.triangles.size() * 12), mesh.triangles.data(), 0);
  const ProgramObject program = make_g_buffer_program();
  const VertexArray vertex_array = make_vertex_array();

  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  glViewport(0, 0, width, height);
  const float zeros[4] = {0, 0, 0, 0}, far = is_reversed(camera) ? 0.0f : 1.0f;
  for (int i = 0; i < 5; ++i) glClearBufferfv(GL_COLOR, i, zeros);
  glClearBufferfv(GL_DEPTH, 0, &far);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(is_reversed(camera) ? GL_GREATER : GL_LESS);
  glClipControl(GL_LOWER_LEFT, camera.clip_depth == ClipDepth::zero_to_one ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
  glUseProgram(program.name());
  glBindVertexArray(vertex_array.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, positions.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, triangles.name());
  const glm::mat4 clip_from_world = camera.projection * camera.view;
  const glm::vec4 eye = eye_of(camera);
  glUniformMatrix4fv(0, 1, GL_FALSE, glm::value_ptr(clip_from_world));
  glUniform4fv(1, 1, glm::value_ptr(eye));
  glUniformMatrix4fv(2, 1, GL_FALSE, glm::value_ptr(camera.view));
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(3 * mesh.triangles.size()));
  glDisable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  glUseProgram(0);
  glBindVertexArray(0);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

GBuffer GBufferPass::by_positions() const {
  return {.width = width_, .height = height_, .positions = positions_.name(), .normals = normals_.name()};
}
GBuffer GBufferPass::by_view_positions() const {
  GBuffer textures = by_positions();
  textures.positions = view_positions_.name();
  textures.position_space = PositionSpace::view;
  return textures;
}
GBuffer GBufferPass::by_depth() const {
  return {.width = width_, .height = height_, .depth = depth_.name(), .normals = normals_.name()};
}
GBuffer GBufferPass::by_linear_depth() const {
  return {.width = width_, .height = height_, .linear_depth = linear_depth_.name(), .normals = normals_.name()};
}

std::vector<Receiver> GBufferPass::receivers() const {
  const std::vector<glm::vec4> positions = read_image(positions_.name(), width_, height_);
  const std::vector<glm::vec4> normals = read_image(normals_.name(), width_, height_);
  std::vector<Receiver> receivers(positions.size());
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    receivers[i].position = positions[i];
    receivers[i].normal = normals[i];
  }
  return receivers;
}

std::vector<int> GBufferPass::faces() const {
  std::vector<int> faces;
  for (const glm::vec4& pixel : read_image(faces_.name(), width_, height_)) {
    faces.push_back(static_cast<int>(pixel.x) - 1);
  }
  return faces;
}

std::vector<Receiver> GBufferPass::exact_receivers(const Mesh& mesh) const {
  std::vector<Receiver> exact = receivers();
  const std::vector<int> shown = faces();
  for (std::size_t i = 0; i < exact.size(); ++i) {
    if (shown[i] < 0) continue;
    Receiver& receiver = exact[i];
    const FacePlane plane(mesh, shown[i], receiver.normal);
    receiver.normal = plane.normal;
    receiver.position = glm::dvec3(receiver.position) - plane.height_of(receiver.position) * plane.normal;
  }
  return exact;
}

FacePlane::FacePlane(const Mesh& mesh, int face, const glm::vec3& towards) {
  const glm::uvec3 t = mesh.triangles[static_cast<std::size_t>(face)];
  const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  corner = a;
  normal = glm::normalize(glm::cross(b - a, c - a));
  if (glm::dot(normal, glm::dvec3(towards)) < 0) normal = -normal;
}

}  // namespace lkao::gl::tests
