// A scene without symmetry, in front of nothing.
#pragma once

#include "scene/camera.h"
#include "scene/mesh.h"

namespace lkao::raster::tests {

// A slanted floor, a wall on its left, and some hundred triangles above it, of all sizes.
scene::Mesh small_scene();

// Sees all of it, and past it on all sides; rolled.
scene::Camera small_camera();

}  // namespace lkao::raster::tests
