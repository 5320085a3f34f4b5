// The modules of OpenMesh's decimater that make up our rule, over our own mesh type. For part_decimater.cpp alone.
//
// All binary modules are asked about a collapse of a vertex v0 into a neighbour v1 until one objects; after a collapse
// again about the neighbours of v0, but no others. So what a module answers may depend on nothing beyond the triangles
// around v0. What they know of the mesh is at its elements (half_edge_mesh.h): the modules of several decimaters share
// it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <OpenMesh/Tools/Decimater/ModBaseT.hh>

#include <glm/vec3.hpp>

#include "lod/half_edge_mesh.h"
#include "lod/near_cells.h"
#include "lod/triangle.h"

namespace lkao::lod {

using DecimaterModule = OpenMesh::Decimater::ModBaseT<HalfEdgeMesh>;

// The triangles that a collapse would leave around v1 in the place of those around v0.
void triangles_after(const HalfEdgeMesh& mesh, const Collapse& collapse, std::vector<Triangle>& triangles);

// Sets the quadrics at the vertices: of the planes around them, weighted by area.
void set_quadrics(HalfEdgeMesh& mesh);

// Error quadrics, and never below zero, where rounding brings some of them on flat ground. Where the quadrics say
// nothing, short edges go first, for rounder triangles.
double collapse_cost(const HalfEdgeMesh& mesh, HalfEdgeMesh::HalfedgeHandle half_edge);

// Of the cheapest collapse of the vertex.
double least_cost(const HalfEdgeMesh& mesh, HalfEdgeMesh::VertexHandle vertex);

// Adds up the quadrics. OpenMesh's ModQuadricT keeps its own, which several decimaters cannot share.
class QuadricModule : public DecimaterModule {
 public:
  using Handle = OpenMesh::Decimater::ModHandleT<QuadricModule>;
  explicit QuadricModule(HalfEdgeMesh& mesh) : DecimaterModule(mesh, false) {}
  const std::string& name() const override;
  float collapse_priority(const Collapse& c) override;
  void postprocess_collapse(const Collapse& c) override;
};

// A vertex with more neighbours than this is not removed: what OpenMesh does for it grows with the square.
inline constexpr unsigned kMostNeighbours = 64;

// No vertex gets more than kMostNeighbours that had fewer.
class GateModule : public DecimaterModule {
 public:
  using Handle = OpenMesh::Decimater::ModHandleT<GateModule>;
  explicit GateModule(HalfEdgeMesh& mesh) : DecimaterModule(mesh, true) {}
  const std::string& name() const override;
  float collapse_priority(const Collapse& c) override;
};

// Keeps borders in place: the old border stays within the tolerance of the new one, and so the new one of the old one.
// Distances between surfaces do not see a notch that is filled.
class BorderModule : public DecimaterModule {
 public:
  using Handle = OpenMesh::Decimater::ModHandleT<BorderModule>;
  explicit BorderModule(HalfEdgeMesh& mesh) : DecimaterModule(mesh, true) {}
  const std::string& name() const override;
  void set_tolerance(double tolerance) { squared_tolerance_ = tolerance * tolerance; }

  float collapse_priority(const Collapse& c) override;
  void preprocess_collapse(const Collapse& c) override;
  void postprocess_collapse(const Collapse& c) override;

 private:
  using Vertex = HalfEdgeMesh::VertexHandle;
  using Points = std::vector<glm::dvec3>;
  Vertex vertex_behind(const Collapse& c);
  Points& points_of(Vertex a, Vertex b);
  void merge(std::pair<Vertex, Vertex> edge, std::pair<Vertex, Vertex> other, Vertex to);

  std::vector<std::pair<Vertex, Points>> merged_;  // of the collapse at hand: the new edges' far ends and points
  double squared_tolerance_ = 0;
};

// Gives the triangles that are larger than the tolerance samples to stand for, as if these were vertices that went.
void add_samples(HalfEdgeMesh& mesh, double tolerance);

// Keeps every vertex that went, and samples of large triangles, within the tolerance of the triangles there now. After
// OpenMesh's ModHausdorffT, which hands points to triangles whose other neighbours are not asked again, and so lets
// distances grow beyond the tolerance, and which takes a triangle of no area as near to everything.
class GoneModule : public DecimaterModule {
 public:
  using Handle = OpenMesh::Decimater::ModHandleT<GoneModule>;
  explicit GoneModule(HalfEdgeMesh& mesh) : DecimaterModule(mesh, true) {}
  const std::string& name() const override;
  void set_tolerance(double tolerance) { tolerance_ = tolerance; }
  float collapse_priority(const Collapse& c) override;
  void preprocess_collapse(const Collapse& c) override;
  void postprocess_collapse(const Collapse& c) override;

 private:
  using Points = std::vector<glm::dvec3>;
  bool is_near(const glm::dvec3& point, std::size_t& guess) const;

  std::vector<Triangle> triangles_;  // of the collapse at hand
  std::vector<HalfEdgeMesh::FaceHandle> faces_;
  Points moved_;
  double tolerance_ = 0;
};

// Keeps every new triangle near to the original surface, at samples: without it, triangles cut through the air where no
// vertex went.
class ReachModule : public DecimaterModule {
 public:
  using Handle = OpenMesh::Decimater::ModHandleT<ReachModule>;
  explicit ReachModule(HalfEdgeMesh& mesh) : DecimaterModule(mesh, true) {}
  const std::string& name() const override;
  // From the unit of the mesh to that of the original: a point p is at p / scale + origin.
  void set_original(const NearCells& original, double scale, const glm::dvec3& origin);

  float collapse_priority(const Collapse& c) override;

 private:
  bool is_near(const Triangle& triangle) const;

  const NearCells* original_ = nullptr;
  double scale_ = 1;
  glm::dvec3 origin_{0};
  double tolerance_ = 0;  // in the unit of the mesh
  std::vector<Triangle> triangles_;
};

}  // namespace lkao::lod
