// One connected part in OpenMesh's decimater.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "lod/near_cells.h"
#include "scene/mesh.h"

namespace lkao::lod {

// A triangle of a simplified part, over the vertices of the original.
struct SimplifiedTriangle {
  glm::uvec3 corners;
  std::uint32_t origin;  // the triangle of the original that it has become of
};

// Removes vertices by half-edge collapses, so that what is left lies at positions of the original, bit for bit. Holes
// stay holes and closed parts closed: no collapse changes the topology, a part keeps a triangle at least.
class PartDecimater {
 public:
  // Told how many triangles went since it was told last, one call at a time; what it throws ends decimate().
  using OnRemoved = std::function<void(std::size_t)>;

  // The mesh must be manifold but for few exceptions, and without zero areas.
  PartDecimater(const scene::Mesh& mesh, OnRemoved on_removed);
  ~PartDecimater();

  // Removes what can go so that new triangles lie near to the original (the mesh itself, or what it was simplified
  // from), and, within that distance less `distance_before` (how far the original may be from the mesh already), every
  // vertex gone of the surface, and old borders of new ones. The vertices marked in `locked` (empty: none) stay. In
  // parallel; the same result at any number of threads. To be called once.
  void decimate(const NearCells& original, double distance_before, std::span<const std::uint8_t> locked);

  std::vector<SimplifiedTriangle> triangles() const;

  // Triangles that OpenMesh would not have as neighbours of the others; they got vertices of their own.
  std::size_t refused_count() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace lkao::lod
