// Scenes by name: a mesh file, or a built-in scene.
#pragma once

#include <string>

#include "scene/mesh_file.h"

namespace lkao::scene {

// "builtin:NAME" (see builtin.h) or the path of a mesh file (see mesh_file.h).
// Throws std::runtime_error with one line that says what is wrong and where.
Mesh load(const std::string& scene);

// The same, and what the file holds besides; of a built-in scene, which the options are not for, nothing.
MeshFile open(const std::string& scene, const ReadOptions& options = {});

}  // namespace lkao::scene
