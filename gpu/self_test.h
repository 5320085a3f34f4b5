// Does the driver do what the passes stand on? Some do not.
#pragma once

#include "lkao/gl.h"

namespace lkao::gl {

// GL_OR on integer attachments: draws overlapping rectangles and compares with the same on the CPU.
bool logic_op_works();

// Draws a prism around the camera: its far side must cover each pixel, and hardly any twice. A program that does not
// link counts as not working.
bool geometry_works(GeometryBackEnd back_end);

// What was asked for, or the first that works. Throw std::runtime_error where none does. They change OpenGL's state: to
// be called within a StateKeeper.
Accumulator choose(Accumulator wanted);
GeometryBackEnd choose(GeometryBackEnd wanted);

}  // namespace lkao::gl
