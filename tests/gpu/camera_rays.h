// What a camera sees, by casting rays: the same receivers whatever the driver.
#pragma once

#include <vector>

#include "lkao/gl.h"
#include "lkao/receiver.h"
#include "support/meshes.h"

namespace lkao::gl::tests {

using lkao::tests::Mesh;

// All pixels, row by row from the bottom, as the pass has them.
std::vector<Receiver> cast_camera_rays(const Mesh& mesh, const Camera& camera, int width, int height);

}  // namespace lkao::gl::tests
