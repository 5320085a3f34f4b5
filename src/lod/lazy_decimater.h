// Half-edge collapses in the order of their cost, in one region of a mesh.
//
// Differs from OpenMesh's DecimaterT, which asks the modules about all collapses of all neighbours after each collapse,
// and forgets nearly all answers unused: this one asks about the cheapest collapse only, when its turn comes. The order
// is the same, at a fraction of the questions.
#pragma once

#include <cstddef>
#include <functional>
#include <queue>
#include <span>
#include <vector>

#include <OpenMesh/Tools/Decimater/BaseDecimaterT.hh>

#include "lod/half_edge_mesh.h"

namespace lkao::lod {

// Uses the modules that are added to it, and the quadrics at the vertices, which must be set. Several of these may work
// on one mesh at a time, each from a thread of its own, while no vertex inside has a neighbour in another's region.
class LazyDecimater : public OpenMesh::Decimater::BaseDecimaterT<HalfEdgeMesh> {
 public:
  using BaseDecimaterT::BaseDecimaterT;

  // Collapses what the modules allow and what costs no more than this, of these vertices and of inner ones near them.
  // To be called once.
  void decimate(std::span<const HalfEdgeMesh::VertexHandle> vertices, double most_cost);

 private:
  using Vertex = HalfEdgeMesh::VertexHandle;

  // A vertex with its cheapest collapse that was not refused yet. Costs may be equal; numbers are not.
  struct Candidate {
    double cost;
    int half_edge;
    int vertex;
    unsigned stamp;  // other than the vertex's: out of date

    bool operator>(const Candidate& other) const {
      return cost != other.cost ? cost > other.cost : half_edge > other.half_edge;
    }
  };

  bool is_allowed(const Collapse& collapse) { return is_collapse_legal(collapse) && collapse_priority(collapse) >= 0; }
  void begin_anew(Vertex vertex);
  void propose(Vertex vertex, const Candidate* refused);
  void perform(Collapse& collapse);

  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue_;
  std::vector<Vertex> ring_;  // of the collapse at hand
};

}  // namespace lkao::lod
