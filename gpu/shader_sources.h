// The shaders, embedded at build time by embed_shaders.cmake.
#pragma once

#include <string>

namespace lkao::gl {

// The text of gpu/shaders/NAME.glsl with what it includes, by NAME: "prism.vert". Throws std::logic_error for a name
// that there is not.
const char* shader_source(const std::string& name);

}  // namespace lkao::gl
