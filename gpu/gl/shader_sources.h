// The shaders, embedded at build time by embed_shaders.cmake.
#pragma once

#include <string>

namespace lkao::gl {

// The text of gpu/NAME.glsl with what it includes: "mesh/prism.vert", or "masks/plane_cells" of a file that shaders
// share. Throws std::logic_error for a name that there is not.
const char* shader_source(const std::string& name);

}  // namespace lkao::gl
