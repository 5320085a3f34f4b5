// Instances for tests, and the one mesh that they stand for.
#pragma once

#include <span>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x3.hpp>

#include "lkao/mesh_instance.h"
#include "support/meshes.h"

namespace lkao::tests {

inline glm::mat4x3 transform(const glm::mat3& linear, const glm::vec3& place) {
  return {linear[0], linear[1], linear[2], place};
}

// Turned anyhow, stretched along the mesh's axes before.
inline glm::mat4x3 random_transform(lut::RandomStream& random, const glm::vec3& scale, const glm::vec3& place) {
  const glm::mat3 turn = glm::mat3_cast(random_rotation(random));
  return transform(glm::mat3(scale.x * turn[0], scale.y * turn[1], scale.z * turn[2]), place);
}

// As mesh_instance.h says, in other words than the library's.
inline glm::vec3 placed(const glm::mat4x3& to_world, const glm::vec3& position) {
  double place[3];
  for (int row = 0; row < 3; ++row) {
    place[row] = double{to_world[0][row]} * double{position.x};
    place[row] += double{to_world[1][row]} * double{position.y};
    place[row] += double{to_world[2][row]} * double{position.z};
    place[row] += double{to_world[3][row]};
  }
  return {place[0], place[1], place[2]};
}

inline MeshInstance instance_of(const Mesh& mesh, const glm::mat4x3& to_world = glm::mat4x3(1)) {
  return {mesh.positions, mesh.triangles, to_world};
}

inline Mesh flattened(std::span<const MeshInstance> instances) {
  Mesh all;
  for (const MeshInstance& instance : instances) {
    const auto first = static_cast<unsigned>(all.positions.size());
    const bool is_mirrored = glm::determinant(glm::dmat3(glm::mat3(instance.to_world))) < 0;
    for (std::size_t i = 0; i < instance.positions.size(); ++i) {
      all.positions.push_back(placed(instance.to_world, instance.positions[i]));
    }
    for (std::size_t i = 0; i < instance.triangles.size(); ++i) {
      const glm::uvec3 t = instance.triangles[i] + first;
      all.triangles.push_back(is_mirrored ? glm::uvec3(t.x, t.z, t.y) : t);
    }
  }
  return all;
}

}  // namespace lkao::tests
