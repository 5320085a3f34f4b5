// What is wrong with a mesh, and a mesh without it.
#pragma once

#include <cstddef>

#include "scene/mesh.h"

namespace lkao::scene {

struct Defects {
  std::size_t non_finite_count = 0;  // triangles with a NaN or infinite corner
  std::size_t zero_area_count = 0;   // triangles whose corners lie on one line (exact, as OccluderBvh judges)
  std::size_t duplicate_count = 0;   // triangles whose three corner positions an earlier one has, in any order
  std::size_t unused_vertex_count = 0;
};

Defects find_defects(const Mesh& mesh);

// Removes non-finite and zero-area triangles (duplicates stay: they are harmless); vertices keep their numbers.
void drop_bad_triangles(Mesh& mesh);

}  // namespace lkao::scene
