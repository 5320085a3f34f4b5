// Internal formats of textures by their names, for messages.
#pragma once

#include <epoxy/gl.h>

#include <string>

namespace lkao::gl {

// "GL_RGBA16F"; as a number where it is none that OpenGL 4.5 has for textures without compression.
std::string format_name(GLenum format);

}  // namespace lkao::gl
