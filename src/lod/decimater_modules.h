// The modules of OpenMesh's decimater that make up our rule, over our own mesh type. For part_decimater.cpp alone.
//
// OpenMesh asks every binary module about each collapse of a vertex v0 into a neighbour v1, and the priority module
// last; afterwards it asks again about the neighbours of v0, but no others. So what a module answers may depend on
// nothing beyond the triangles around v0.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/ModBaseT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include <glm/vec3.hpp>

#include "lod/triangle.h"

namespace lkao::lod {

struct HalfEdgeTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<HalfEdgeTraits>;
using Collapse = OpenMesh::Decimater::CollapseInfoT<HalfEdgeMesh>;
using DecimaterModule = OpenMesh::Decimater::ModBaseT<HalfEdgeMesh>;

// The triangles that a collapse would leave around v1 in the place of those around v0.
void triangles_after(const HalfEdgeMesh& mesh, const Collapse& collapse, std::vector<Triangle>& triangles);

// Error quadrics as priority, as OpenMesh has them, but never below zero: on flat ground rounding makes some of them
// negative, which the decimater takes for a collapse that is not allowed. Where the quadrics say nothing, short edges
// go first, for rounder triangles.
class QuadricModule : public OpenMesh::Decimater::ModQuadricT<HalfEdgeMesh> {
 public:
  using Handle = OpenMesh::Decimater::ModHandleT<QuadricModule>;
  using ModQuadricT::ModQuadricT;

  float collapse_priority(const Collapse& collapse) override;
  void postprocess_collapse(const Collapse& collapse) override;

  // False where a better collapse of the same vertex is known already: the other modules need not be asked.
  bool is_better(const Collapse& collapse);

 private:
  float cost(const Collapse& collapse);
  HalfEdgeMesh::VertexHandle vertex_;  // asked about last
  float best_ = 0;                     // of its collapses that all modules allow
};

// A vertex with more neighbours than this is not removed: what OpenMesh does for it grows with the square.
inline constexpr unsigned kMostNeighbours = 64;

// What is quick to decide, before the modules that cost time: whether QuadricModule::is_better (the result is the same
// without it), and that no vertex gets more than kMostNeighbours that had fewer.
class GateModule : public DecimaterModule {
 public:
  using Handle = OpenMesh::Decimater::ModHandleT<GateModule>;
  explicit GateModule(HalfEdgeMesh& mesh) : DecimaterModule(mesh, true) {}
  const std::string& name() const override;
  void set_quadric(QuadricModule& quadric) { quadric_ = &quadric; }
  float collapse_priority(const Collapse& c) override;

 private:
  QuadricModule* quadric_ = nullptr;
};

// Keeps borders in place: the old border stays within the tolerance of the new one, and so the new one of the old one.
// Distances between surfaces do not see a notch that is filled.
class BorderModule : public DecimaterModule {
 public:
  using Handle = OpenMesh::Decimater::ModHandleT<BorderModule>;
  explicit BorderModule(HalfEdgeMesh& mesh) : DecimaterModule(mesh, true) { mesh.add_property(gone_); }
  ~BorderModule() override { mesh().remove_property(gone_); }
  BorderModule(const BorderModule&) = delete;
  BorderModule& operator=(const BorderModule&) = delete;
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

  OpenMesh::EPropHandleT<Points> gone_;            // from the border at this edge
  std::vector<std::pair<Vertex, Points>> merged_;  // of the collapse at hand: the new edges' far ends and points
  double squared_tolerance_ = 0;
};

// Keeps every vertex that went, and samples of large triangles, within the tolerance of the triangles there now. After
// OpenMesh's ModHausdorffT, which hands points to triangles whose other neighbours are not asked again, and so lets
// distances grow beyond the tolerance, and which takes a triangle of no area as near to everything.
class GoneModule : public DecimaterModule {
 public:
  using Handle = OpenMesh::Decimater::ModHandleT<GoneModule>;
  explicit GoneModule(HalfEdgeMesh& mesh) : DecimaterModule(mesh, true) { mesh.add_property(gone_); }
  ~GoneModule() override { mesh().remove_property(gone_); }
  GoneModule(const GoneModule&) = delete;
  GoneModule& operator=(const GoneModule&) = delete;
  const std::string& name() const override;
  void set_tolerance(double tolerance) { tolerance_ = tolerance; }
  // Samples the triangles that are larger than the tolerance.
  void add_samples();

  float collapse_priority(const Collapse& c) override;
  void preprocess_collapse(const Collapse& c) override;
  void postprocess_collapse(const Collapse& c) override;

 private:
  using Points = std::vector<glm::dvec3>;
  bool is_near(const glm::dvec3& point, std::size_t& guess) const;

  OpenMesh::FPropHandleT<Points> gone_;  // the points that this triangle stands for
  std::vector<Triangle> triangles_;      // of the collapse at hand
  std::vector<HalfEdgeMesh::FaceHandle> faces_;
  Points moved_;
  double tolerance_ = 0;
};

// Keeps every new triangle within the tolerance of the original surface, at samples: without it, triangles cut through
// the air where no vertex went.
class ReachModule : public DecimaterModule {
 public:
  using Handle = OpenMesh::Decimater::ModHandleT<ReachModule>;
  // True where the point is at most this far from the original surface.
  using IsWithin = std::function<bool(const glm::dvec3& point, double distance)>;
  explicit ReachModule(HalfEdgeMesh& mesh) : DecimaterModule(mesh, true) {}
  const std::string& name() const override;
  void set_original(IsWithin is_within) { is_within_ = std::move(is_within); }
  void set_tolerance(double tolerance) { tolerance_ = tolerance; }

  float collapse_priority(const Collapse& c) override;

 private:
  bool is_near(const Triangle& triangle) const;

  IsWithin is_within_;
  std::vector<Triangle> triangles_;
  double tolerance_ = 0;
};

}  // namespace lkao::lod
