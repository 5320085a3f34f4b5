// Meshes of the modules around the library, from arrays and back.
#pragma once

#include "python/arrays.h"
#include "scene/camera.h"
#include "scene/mesh.h"

namespace lkao::python {

// A copy. Throws std::invalid_argument, naming triangle and index, where an index is not one of the positions.
scene::Mesh mesh_of(const py::array& positions, const py::array& triangles, const Triple& origin);

// Of numbers less the mesh's origin.
scene::Camera camera_of(const Triple& eye, const Triple& target, const Triple& up, float fov);

}  // namespace lkao::python
