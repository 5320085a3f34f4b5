// An indexed triangle mesh that owns its arrays.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "lkao/occluder_bvh.h"

namespace lkao::scene {

struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;

  TriangleMesh view() const { return {positions, triangles}; }
};

// Box around the finite positions that some triangle uses; empty (lower > upper) where there is none.
Bounds bounds_of(const Mesh& mesh);

// Adds the triangles of `part` behind those of `mesh`.
void append(Mesh& mesh, const Mesh& part);

// Unit normals, one a vertex, weighted by the angles of the triangles around it; zero where there is no usable
// triangle.
std::vector<glm::vec3> vertex_normals(const Mesh& mesh);

}  // namespace lkao::scene
