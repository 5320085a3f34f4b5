// Meshes to bake: with what a baked value hangs on besides positions and triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "python/arrays.h"
#include "python/holes.h"
#include "scene/corner_normals.h"
#include "scene/mesh.h"

namespace lkao::python {

// What a surface may have besides positions and triangles.
struct SurfaceArrays {
  std::optional<py::array> normals;    // float32, packed: (n, 3) of vertices or (m, 3, 3) of corners; zero: none there
  std::optional<py::array> uvs;        // float32, packed: (n, 2) or (m, 3, 2), as scene::Mesh has them; NaN: none there
  std::optional<py::array> materials;  // uint32, (m,)
  const MeshHoles* holes = nullptr;    // of its triangles, for rays that meet it
};

// A copy of arrays, without the triangles that are none. Stays where it is made.
class Surface {
 public:
  // `source`: "file" stands for the normals of `more`. Throws std::invalid_argument naming what is wrong.
  Surface(const py::array& positions, const py::array& triangles, const Triple& origin, const std::string& source,
          const SurfaceArrays& more);
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

  const scene::Mesh& mesh() const { return mesh_; }
  const scene::CornerNormals& normals() const { return *normals_; }

  // Of the arrays.
  std::size_t triangle_count() const { return triangle_count_; }
  // The numbers in the arrays of the mesh's triangles: those of the others are without area, or not finite.
  const std::vector<std::size_t>& kept() const { return kept_; }
  // Of the others, how many have this material; none: of all.
  std::size_t dropped_count(std::optional<std::uint32_t> material) const;

 private:
  void drop_bad_triangles();

  scene::Mesh mesh_;
  std::size_t triangle_count_ = 0;
  std::vector<std::size_t> kept_;
  std::vector<std::uint32_t> dropped_materials_;  // of each that is left out
  std::optional<scene::CornerNormals> normals_;
};

}  // namespace lkao::python
