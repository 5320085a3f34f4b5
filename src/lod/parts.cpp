#include "lod/parts.h"

#include <algorithm>
#include <array>
#include <numeric>

#include <tbb/parallel_sort.h>

#include "lod/triangle_pairs.h"
#include "scene/defects.h"
#include "scene/disjoint_sets.h"

namespace lkao::lod {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

bool is_before(const glm::vec3& a, const glm::vec3& b) {
  if (a.x != b.x) return a.x < b.x;
  return a.y != b.y ? a.y < b.y : a.z < b.z;
}

// Makes vertices at equal positions one (-0 equals 0); leaves out what no triangle uses.
void join_vertices(scene::Mesh& mesh) {
  std::vector<std::uint32_t> order;
  std::vector<bool> used(mesh.positions.size(), false);
  for (const glm::uvec3& t : mesh.triangles) used[t.x] = used[t.y] = used[t.z] = true;
  for (std::uint32_t i = 0; i < used.size(); ++i) {
    if (used[i]) order.push_back(i);
  }
  tbb::parallel_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const glm::vec3 &p = mesh.positions[a], &q = mesh.positions[b];
    return p != q ? is_before(p, q) : a < b;
  });
  std::vector<std::uint32_t> first(mesh.positions.size(), kNone);  // of the vertices at the same position
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool again = i > 0 && mesh.positions[order[i]] == mesh.positions[order[i - 1]];
    first[order[i]] = again ? first[order[i - 1]] : order[i];
  }

  std::vector<std::uint32_t> number(mesh.positions.size(), kNone);
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    if (first[i] != i) continue;
    mesh.positions[count] = mesh.positions[i];
    number[i] = count++;
  }
  mesh.positions.resize(count);
  for (glm::uvec3& t : mesh.triangles) t = {number[first[t.x]], number[first[t.y]], number[first[t.z]]};
}

// The corners in turn, beginning with the lowest.
std::array<std::uint32_t, 3> turned(const glm::uvec3& t) {
  if (t.x < t.y && t.x < t.z) return {t.x, t.y, t.z};
  if (t.y < t.z) return {t.y, t.z, t.x};
  return {t.z, t.x, t.y};
}

// Keeps the first of equal triangles; returns how many went.
std::size_t drop_duplicates(std::vector<glm::uvec3>& triangles) {
  std::vector<std::uint32_t> order(triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  tbb::parallel_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto p = turned(triangles[a]), q = turned(triangles[b]);
    return p != q ? p < q : a < b;
  });
  std::vector<bool> again(triangles.size(), false);
  for (std::size_t i = 1; i < order.size(); ++i) {
    again[order[i]] = turned(triangles[order[i]]) == turned(triangles[order[i - 1]]);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (!again[i]) triangles[kept++] = triangles[i];
  }
  const std::size_t dropped = triangles.size() - kept;
  triangles.resize(kept);
  return dropped;
}

// Puts triangles that are paired across an edge into one part; corners that meet across paired edges are one vertex.
class Splitter {
 public:
  Splitter(const scene::Mesh& mesh, const TrianglePairs& pairs)
      : mesh_(mesh), triangle_sets_(mesh.triangles.size()), corner_sets_(3 * mesh.triangles.size()) {
    for (HalfEdge edge = 0; edge < pairs.partner.size(); ++edge) {
      const HalfEdge partner = pairs.partner[edge];
      if (partner == kNoHalfEdge || partner < edge) continue;
      triangle_sets_.join(edge / 3, partner / 3);
      corner_sets_.join(edge, next_in_triangle(partner));
      corner_sets_.join(next_in_triangle(edge), partner);
    }
  }

  std::vector<Part> parts() {
    std::vector<Part> parts;
    std::vector<std::uint32_t> part_of(mesh_.triangles.size(), kNone);        // by the root of the triangle
    std::vector<std::uint32_t> vertex_of(3 * mesh_.triangles.size(), kNone);  // by the root of the corner
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      std::uint32_t& part_number = part_of[triangle_sets_.find(t)];
      if (part_number == kNone) {
        part_number = static_cast<std::uint32_t>(parts.size());
        parts.emplace_back();
      }
      Part& part = parts[part_number];
      glm::uvec3 triangle{};
      for (std::uint32_t i = 0; i < 3; ++i) {
        std::uint32_t& vertex = vertex_of[corner_sets_.find(3 * t + i)];
        if (vertex == kNone) vertex = add_vertex(part, mesh_.triangles[t][static_cast<int>(i)]);
        triangle[static_cast<int>(i)] = vertex;
      }
      part.mesh.triangles.push_back(triangle);
    }
    return parts;
  }

 private:
  std::uint32_t add_vertex(Part& part, std::uint32_t scene_vertex) const {
    part.mesh.positions.push_back(mesh_.positions[scene_vertex]);
    part.scene_vertices.push_back(scene_vertex);
    return static_cast<std::uint32_t>(part.scene_vertices.size() - 1);
  }

  const scene::Mesh& mesh_;
  scene::DisjointSets triangle_sets_;
  scene::DisjointSets corner_sets_;
};

std::size_t count_split_vertices(const SceneParts& scene) {
  std::vector<std::uint32_t> use_count(scene.positions.size(), 0);
  for (const Part& part : scene.parts) {
    for (const std::uint32_t vertex : part.scene_vertices) ++use_count[vertex];
  }
  return static_cast<std::size_t>(std::ranges::count_if(use_count, [](std::uint32_t count) { return count > 1; }));
}

}  // namespace

SceneParts split_into_parts(const scene::Mesh& mesh) {
  SceneParts scene;
  const scene::Defects defects = scene::find_defects(mesh);
  scene.zero_area_count = defects.zero_area_count;
  scene.non_finite_count = defects.non_finite_count;

  scene::Mesh clean = mesh;
  scene::drop_bad_triangles(clean);
  join_vertices(clean);
  scene.duplicate_count = drop_duplicates(clean.triangles);

  const TrianglePairs pairs = pair_triangles(clean.positions, clean.triangles);
  scene.wrong_winding_edge_count = pairs.wrong_winding_count;
  scene.crowded_edge_count = pairs.crowded_edge_count;
  scene.parts = Splitter(clean, pairs).parts();
  scene.positions = std::move(clean.positions);
  scene.split_vertex_count = count_split_vertices(scene);
  return scene;
}

}  // namespace lkao::lod
