// From a camera to what the shaders need of it.
#pragma once

#include "gpu/pass_uniforms.h"
#include "lkao/gl.h"

namespace lkao::gl {

// Fills the uniforms that hang on the camera, the flags among them. Throws std::invalid_argument where `view` is no
// rigid motion or `projection` neither perspective nor orthographic.
void set_view(const Camera& camera, int width, int height, float radius, PassUniforms& uniforms);

// True where the screen shows the world mirrored, so that fronts of triangles run clockwise.
bool is_mirrored(const Camera& camera);

}  // namespace lkao::gl
