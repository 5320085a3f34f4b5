// Where a mesh stands in the world.
//
// An instance blocks like the mesh whose corners are transformed in double precision and rounded once to float: the
// definition of TriangleTest, decided in the world. Two triangles that share a corner share it there as well, so a mesh
// that is closed stays closed, wherever its transform takes it.
#pragma once

#include <cstdint>

#include <glm/common.hpp>
#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>

#include "bvh/layout.h"
#include "lkao/occluder_bvh.h"

namespace lkao::bvh {

struct Placement {
  glm::mat4x3 to_world;
  glm::dmat4x3 to_mesh;
  Bounds box;  // in the world, of all corners
  glm::vec3
      displacement;  // by axis of the mesh: no more lies between a corner and where to_mesh takes it from the world
  float shrink;      // vectors become shorter by no more than this in the mesh's space
  std::uint32_t mesh;
  std::uint32_t groups;
  bool is_mirrored;
  // Vectors of floats may answer it in the mesh's space; otherwise the transform is too flat for them.
  bool suits_floats;

  bool is_identity() const { return to_world == glm::mat4x3(1); }
};

// The place of a position in the world: every sum in this order, on every processor.
inline glm::vec3 place(const glm::mat4x3& to_world, const glm::vec3& position) {
  glm::vec3 placed;
  for (int row = 0; row < 3; ++row) {
    const double x = double{to_world[0][row]} * double{position.x}, y = double{to_world[1][row]} * double{position.y};
    placed[row] = static_cast<float>(x + y + double{to_world[2][row]} * double{position.z} + double{to_world[3][row]});
  }
  return placed;
}

// A box in the world around what the mesh's box holds, and a little around that.
Bounds place(const glm::mat4x3& to_world, const Bounds& box);

// Of a mesh with an invertible, finite transform. The box is empty where the mesh has no occluder.
Placement make_placement(const Layout& mesh, std::uint32_t mesh_number, const glm::mat4x3& to_world,
                         std::uint32_t groups);

}  // namespace lkao::bvh
