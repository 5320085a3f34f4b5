// The engine's renderer: a G-buffer of depth, normals and colours, and a pass that lights it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace moving_mesh {

class Renderer {
 public:
  // Needs a current context of OpenGL 4.5, for all members. Colours: one a vertex.
  Renderer(int width, int height, std::span<const glm::uvec3> triangles, std::span<const glm::vec3> colors);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Draws the mesh into depth, normals and colours.
  void draw_g_buffer(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals);
  // Makes the picture of the G-buffer and of occlusion().
  void shade();

  int width() const { return width_; }
  int height() const { return height_; }
  glm::mat4 view() const { return view_; }
  // Reversed Z without a far plane: depths are 1 at the near plane and fall to 0.
  glm::mat4 projection() const { return projection_; }
  unsigned depth() const { return depth_; }          // GL_DEPTH_COMPONENT32F
  unsigned normals() const { return normals_; }      // GL_RGBA16F, world space
  unsigned occlusion() const { return occlusion_; }  // GL_R8: what shade() dims the light by

  // The picture, RGB, row by row from the top.
  std::vector<std::uint8_t> read_picture() const;
  // The texture of occlusion, row by row from the bottom.
  std::vector<std::uint8_t> read_occlusion() const;

 private:
  int width_, height_, index_count_;
  glm::mat4 view_, projection_;
  unsigned depth_ = 0, normals_ = 0, colors_ = 0, occlusion_ = 0, picture_ = 0;
  unsigned g_buffer_ = 0, target_ = 0;  // framebuffers
  unsigned position_buffer_ = 0, normal_buffer_ = 0, color_buffer_ = 0, index_buffer_ = 0;
  unsigned vertex_array_ = 0, no_attributes_ = 0;
  unsigned mesh_program_ = 0, shade_program_ = 0;
};

}  // namespace moving_mesh
