// Mesh files in: OBJ, PLY, STL, OFF, glTF and GLB, through assimp.
#pragma once

#include <string>

#include "scene/mesh.h"

namespace lkao::scene {

// Reads every triangle of the file: node transforms applied, polygons fanned into triangles, points and lines left
// out, degenerate and non-finite triangles kept (drop_bad_triangles sorts those out). Vertices with equal bits are
// joined where the format gives every corner its own (STL).
//
// Throws std::runtime_error with one line naming the file and the fault: missing, a directory, an unsupported type,
// empty, truncated or malformed, an index out of range, no triangles.
Mesh read_mesh_file(const std::string& path);

}  // namespace lkao::scene
