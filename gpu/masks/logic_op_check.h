// Does the driver OR into integer attachments? Some do not.
#pragma once

#include "lkao/gl/mask_pass.h"

namespace lkao::gl {

// GL_OR on integer attachments: draws overlapping rectangles and compares with the same on the CPU.
bool logic_op_works();

// What was asked for, or the first that works. Changes OpenGL's state: to be called within a StateKeeper.
Accumulator choose(Accumulator wanted);

}  // namespace lkao::gl
