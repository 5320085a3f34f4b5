// The mesh of OpenMesh's in which a part is simplified, with what our rules keep at its elements. For the decimater
// alone.
#pragma once

#include <vector>

// First: QuadricT.hh uses it without including it.
#include <OpenMesh/Core/Utils/vector_traits.hh>

#include <OpenMesh/Core/Geometry/QuadricT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/CollapseInfoT.hh>

#include <glm/vec3.hpp>

namespace lkao::lod {

using Quadric = OpenMesh::Geometry::Quadricd;

// In the elements and not in the modules: several sets of modules work on one mesh, each in a region of its own.
struct HalfEdgeTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;

  template <class Base, class Refs>
  struct VertexT : Base {
    Quadric quadric;          // of its triangles, and of the vertices that became it
    unsigned stamp = 0;       // of its newest entry in the queue
    bool is_inside = true;    // of the region that is worked on: only such vertices go, and only to such
    bool is_settled = false;  // no collapse of it is allowed, until its surroundings change
  };
  template <class Base, class Refs>
  struct EdgeT : Base {
    std::vector<glm::dvec3> gone;  // vertices that went from the border at this edge
  };
  template <class Base, class Refs>
  struct FaceT : Base {
    std::vector<glm::dvec3> gone;  // the points that this triangle stands for
  };
};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<HalfEdgeTraits>;
using Collapse = OpenMesh::Decimater::CollapseInfoT<HalfEdgeMesh>;

inline glm::dvec3 to_glm(const HalfEdgeMesh::Point& p) { return {p[0], p[1], p[2]}; }

}  // namespace lkao::lod
