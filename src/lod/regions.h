// Regions of a mesh that can be simplified at the same time.
#pragma once

#include <vector>

#include "lod/half_edge_mesh.h"

namespace lkao::lod {

using VertexGroup = std::vector<HalfEdgeMesh::VertexHandle>;

// Groups the vertices that are there by their place, at most so many in each, and sets `is_inside`: true where all
// neighbours of a vertex are in its group. The vertices between groups keep to their place, and so do all triangles
// there: a collapse inside of one group never touches what a collapse inside of another reads. The same at any number
// of threads.
std::vector<VertexGroup> split_into_regions(HalfEdgeMesh& mesh, std::size_t most_vertices);

// All vertices are inside again.
void join_regions(HalfEdgeMesh& mesh);

}  // namespace lkao::lod
