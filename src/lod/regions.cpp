#include "lod/regions.h"

#include <algorithm>
#include <span>

#include <glm/common.hpp>

namespace lkao::lod {
namespace {

using Vertex = HalfEdgeMesh::VertexHandle;

int longest_axis(const HalfEdgeMesh& mesh, std::span<const Vertex> vertices) {
  glm::dvec3 lower = to_glm(mesh.point(vertices.front())), upper = lower;
  for (const Vertex vertex : vertices) {
    lower = glm::min(lower, to_glm(mesh.point(vertex)));
    upper = glm::max(upper, to_glm(mesh.point(vertex)));
  }
  const glm::dvec3 size = upper - lower;
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

// Halves the vertices along the longest side of their box, until there are few enough.
void split(const HalfEdgeMesh& mesh, std::span<Vertex> vertices, std::size_t most, std::vector<VertexGroup>& groups) {
  if (vertices.size() <= most) {
    groups.emplace_back(vertices.begin(), vertices.end());
    return;
  }
  const auto axis = static_cast<unsigned>(longest_axis(mesh, vertices));
  const std::size_t half = vertices.size() / 2;
  const auto is_before = [&](Vertex a, Vertex b) {
    const double x = mesh.point(a)[axis], y = mesh.point(b)[axis];
    return x != y ? x < y : a.idx() < b.idx();
  };
  std::ranges::nth_element(vertices, vertices.begin() + static_cast<std::ptrdiff_t>(half), is_before);
  split(mesh, vertices.first(half), most, groups);
  split(mesh, vertices.subspan(half), most, groups);
}

}  // namespace

std::vector<VertexGroup> split_into_regions(HalfEdgeMesh& mesh, std::size_t most_vertices) {
  VertexGroup vertices;
  for (const Vertex vertex : mesh.vertices()) vertices.push_back(vertex);  // without the deleted ones
  std::vector<VertexGroup> groups;
  split(mesh, vertices, most_vertices, groups);

  std::vector<std::size_t> group_of(mesh.n_vertices());
  const auto place = [](Vertex vertex) { return static_cast<std::size_t>(vertex.idx()); };
  for (std::size_t i = 0; i < groups.size(); ++i) {
    for (const Vertex vertex : groups[i]) group_of[place(vertex)] = i;
  }
  for (const Vertex vertex : vertices) {
    const auto is_near = [&](Vertex other) { return group_of[place(other)] == group_of[place(vertex)]; };
    bool& is_inside = mesh.data(vertex).is_inside;
    is_inside = true;
    for (auto other = mesh.cvv_iter(vertex); is_inside && other.is_valid(); ++other) is_inside = is_near(*other);
  }
  return groups;
}

void join_regions(HalfEdgeMesh& mesh) {
  for (const Vertex vertex : mesh.vertices()) mesh.data(vertex).is_inside = true;
}

}  // namespace lkao::lod
