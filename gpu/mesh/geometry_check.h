// Does the driver draw shapes without cracks? Some do not.
#pragma once

#include "lkao/gl/occluders.h"

namespace lkao::gl {

// Draws a prism around the camera: its far side must cover each pixel, and hardly any twice. A program that does not
// link counts as not working.
bool geometry_works(GeometryBackEnd back_end);

// What was asked for, or the first that works. Throws std::runtime_error where none does. Changes OpenGL's state: to be
// called within a StateKeeper.
GeometryBackEnd choose(GeometryBackEnd wanted);

}  // namespace lkao::gl
