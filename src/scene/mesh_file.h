// Mesh files in: OBJ, STL, glTF and GLB through assimp; PLY and OFF by readers of our own (mesh_formats.h says why).
#pragma once

#include <string>

#include "scene/mesh.h"

namespace lkao::scene {

// Reads every triangle of the file: node transforms applied, polygons fanned into triangles, points and lines left
// out, degenerate and non-finite triangles kept (drop_bad_triangles sorts those out). PLY and OFF keep
// their vertices as they are numbered; elsewhere, where every corner has its own, vertices at equal positions are
// joined.
//
// Throws std::runtime_error with one line naming the file and the fault: missing, a directory, an unsupported type,
// empty, truncated or malformed, an index out of range, no triangles.
Mesh read_mesh_file(const std::string& path);

}  // namespace lkao::scene
