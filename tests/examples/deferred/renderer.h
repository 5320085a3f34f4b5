// The geometry pass of a deferred renderer, after a well-known tutorial (J. de Vries, LearnOpenGL, "SSAO"): positions
// and normals in textures of half floats, in view space, beside a depth of 24 bits, near plane at 0.1 and far plane at
// 50; or another kind of G-buffer.
#pragma once

#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "kinds.h"
#include "scene/camera.h"
#include "scene/mesh.h"

namespace deferred {

class Renderer {
 public:
  // Needs a current context of OpenGL 4.5, for all members. Normals are those of the triangles, turned to the eye.
  Renderer(const lkao::scene::Mesh& mesh, const lkao::scene::Camera& camera, int width, int height);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  void draw_g_buffer(const Kind& kind);

  // Of the last draw_g_buffer().
  lkao::gl::GBuffer g_buffer() const;
  lkao::gl::Camera camera() const;
  // GL_R32F; the second of half the size.
  unsigned occlusion() const { return occlusion_; }
  unsigned half_occlusion() const { return half_occlusion_; }

  // The texture of occlusion, row by row from the bottom.
  std::vector<float> read_occlusion() const;

 private:
  void make_textures();
  void delete_textures();

  int width_, height_, vertex_count_;
  glm::mat4 view_;
  float horizontal_scale_;  // of the projection
  Kind kind_{};
  unsigned vertices_ = 0, vertex_array_ = 0, program_ = 0;
  unsigned framebuffer_ = 0, place_ = 0, depth_ = 0, normals_ = 0;
  unsigned occlusion_ = 0, half_occlusion_ = 0;
};

}  // namespace deferred
