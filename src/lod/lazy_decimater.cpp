#include "lod/lazy_decimater.h"

#include "lod/decimater_modules.h"

namespace lkao::lod {

void LazyDecimater::decimate(std::span<const Vertex> vertices, double most_cost) {
  for (const Vertex vertex : vertices) begin_anew(vertex);
  std::size_t count = 0;
  while (!queue_.empty() && queue_.top().cost <= most_cost) {
    const Candidate candidate = queue_.top();
    queue_.pop();
    const Vertex vertex(candidate.vertex);
    if (mesh().data(vertex).stamp != candidate.stamp) continue;
    Collapse collapse(mesh(), HalfEdgeMesh::HalfedgeHandle(candidate.half_edge));
    if (!is_allowed(collapse)) {
      propose(vertex, &candidate);
      continue;
    }
    perform(collapse);
    notify_observer(++count);
  }
}

void LazyDecimater::begin_anew(Vertex vertex) {
  auto& data = mesh().data(vertex);
  data.is_settled = false;
  ++data.stamp;
  if (data.is_inside && !mesh().status(vertex).locked()) propose(vertex, nullptr);
}

// The cheapest collapse of the vertex; after a refused one, the next.
void LazyDecimater::propose(Vertex vertex, const Candidate* refused) {
  Candidate best{}, candidate{.cost = 0, .half_edge = 0, .vertex = vertex.idx(), .stamp = mesh().data(vertex).stamp};
  bool is_found = false, is_at_rim = false;
  for (auto edge = mesh().cvoh_iter(vertex); edge.is_valid(); ++edge) {
    if (!mesh().data(mesh().to_vertex_handle(*edge)).is_inside) {
      is_at_rim = true;
      continue;
    }
    candidate.cost = collapse_cost(mesh(), *edge);
    candidate.half_edge = edge->idx();
    if (refused != nullptr && !(candidate > *refused)) continue;
    if (is_found && candidate > best) continue;
    best = candidate;
    is_found = true;
  }
  if (is_found) queue_.push(best);
  mesh().data(vertex).is_settled = !is_found && !is_at_rim;
}

void LazyDecimater::perform(Collapse& collapse) {
  ring_.clear();
  for (auto vertex = mesh().cvv_iter(collapse.v0); vertex.is_valid(); ++vertex) ring_.push_back(*vertex);
  preprocess_collapse(collapse);
  mesh().collapse(collapse.v0v1);
  ++mesh().data(collapse.v0).stamp;
  for (auto face = mesh().cvf_iter(collapse.v1); face.is_valid(); ++face) {
    mesh().set_normal(*face, mesh().calc_face_normal(*face));
  }
  postprocess_collapse(collapse);
  for (const Vertex vertex : ring_) begin_anew(vertex);
}

}  // namespace lkao::lod
