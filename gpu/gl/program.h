// Programs of the embedded shaders.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gpu/gl/objects.h"

namespace lkao::gl {

// Macros and their values, put after the first line of every shader.
using Defines = std::vector<std::pair<std::string, int>>;

// Compiles and links the shaders of these names, such as "prism.vert" and "accumulate.frag". Throws std::runtime_error
// with the first line of the driver's complaint.
ProgramObject make_program(const std::vector<std::string>& names, const Defines& defines = {});

// The same with a text instead of the name of an embedded shader.
ProgramObject make_program_of(GLenum stage, const std::string& name, const std::string& text);

}  // namespace lkao::gl
