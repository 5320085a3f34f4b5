// What normal each corner of each triangle has: for shading, and to tell creases from seams.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

#include "scene/mesh.h"

namespace lkao::scene {

enum class NormalSource {
  file,    // what came with the mesh; a corner without one is smooth
  smooth,  // of all triangles around its position, weighted by angle; seams do not count, and faces that lie back to
           // back, as those of a leaf, do not cancel
  facet,   // the triangle's own
};

// Those of the file where the mesh has any, and those of the facets where it has none.
NormalSource usual_normals(const Mesh& mesh);

// Unit vectors, all on one side of a usable triangle's plane: that of its front, but for normals of a file, which say
// themselves what is in front. One of a corner that points to the other side is replaced by the facet's.
struct TriangleNormals {
  glm::dvec3 facet;
  std::array<glm::vec3, 3> corners;
};

// The mesh must outlive it, unchanged.
class CornerNormals {
 public:
  CornerNormals(const Mesh& mesh, NormalSource source);

  NormalSource source() const { return source_; }
  const Mesh& mesh() const { return mesh_; }

  TriangleNormals of(std::size_t triangle) const;

 private:
  const Mesh& mesh_;
  NormalSource source_;
  std::vector<glm::vec3> smooth_;
  std::vector<glm::uvec3> smooth_corners_;
};

}  // namespace lkao::scene
