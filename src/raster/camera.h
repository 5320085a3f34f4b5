// The camera of the OpenGL side that sees what a camera of the program sees.
#pragma once

#include "lkao/gl.h"
#include "scene/camera.h"

namespace lkao::raster {

// Texture row y is the image's row y from the top, so that pixels have the same numbers as those of find_receivers():
// the projection is upside down. Its depth range says nothing: for G-buffers of positions. `camera` as
// scene::validate() wants it.
gl::Camera gl_camera(const scene::Camera& camera, int width, int height);

}  // namespace lkao::raster
