// A mesh taken apart into connected parts, each a manifold with borders, as mesh simplification needs them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/mesh.h"

namespace lkao::lod {

struct Part {
  scene::Mesh mesh;
  // The vertex of SceneParts::positions behind each vertex of the mesh. Where the scene is not manifold, several
  // vertices of one part, or of several parts, stand for the same one.
  std::vector<std::uint32_t> scene_vertices;
};

struct SceneParts {
  std::vector<glm::vec3> positions;  // bit-equal ones joined
  std::vector<Part> parts;           // in the order of their first triangles

  // Triangles left out, because without them the same rays are blocked.
  std::size_t zero_area_count = 0;
  std::size_t non_finite_count = 0;
  std::size_t duplicate_count = 0;  // same corners, same winding as an earlier one

  // What was not manifold.
  std::size_t wrong_winding_edge_count = 0;
  std::size_t crowded_edge_count = 0;
  std::size_t split_vertex_count = 0;  // vertices that stand for several
};

// Every triangle of the mesh is in one part or counted as left out. Indices must be in range.
SceneParts split_into_parts(const scene::Mesh& mesh);

}  // namespace lkao::lod
