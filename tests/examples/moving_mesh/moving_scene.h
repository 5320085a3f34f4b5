// The engine's scene: a room in which a ball bounces and a cloth waves.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

#include "scene/mesh.h"

namespace moving_mesh {

class MovingScene {
 public:
  MovingScene();

  // Puts the vertices where they are at that time. Triangles stay the same.
  void move_to(double seconds);

  const lkao::scene::Mesh& mesh() const { return mesh_; }
  // One a vertex, linear.
  const std::vector<glm::vec3>& colors() const { return colors_; }

 private:
  // What was added to the mesh since the last call gets this colour.
  void paint(const glm::vec3& color) { colors_.resize(mesh_.positions.size(), color); }
  void build_room();
  void move_ball(double seconds);
  void move_cloth(double seconds);

  lkao::scene::Mesh mesh_;
  std::vector<glm::vec3> colors_;
  std::vector<glm::vec3> ball_;  // around the origin
  std::size_t first_of_ball_ = 0;
  std::size_t first_of_cloth_ = 0;
};

}  // namespace moving_mesh
