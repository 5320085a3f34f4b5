// What moves the vertices of a skinned mesh.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/mat4x4.hpp>

#include "scene/formats/gltf/accessors.h"
#include "scene/formats/gltf/nodes.h"
#include "scene/formats/gltf/shape.h"

namespace lkao::scene::gltf {

// A skin at rest: its joints stand where their nodes do. Throws std::runtime_error with the fault.
class Skin {
 public:
  Skin(const Value& root, const Value& skin, const Nodes& nodes, Accessors& accessors);

  // From the mesh to the world, for one vertex. The weights are brought to a sum of one, as stored ones are rounded;
  // where all are zero the first joint has them all.
  glm::dmat4 matrix_of(const Vertices& vertices, std::size_t vertex) const;

 private:
  const glm::dmat4& matrix_of_joint(double number) const;

  std::string place_;
  std::vector<glm::dmat4> matrices_;  // one a joint
};

}  // namespace lkao::scene::gltf
