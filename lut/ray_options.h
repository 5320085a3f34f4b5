// RayOptions checked: one place for the query and the OpenGL passes.
#pragma once

#include "lkao/receiver.h"

namespace lkao::lut {

// Throws std::invalid_argument "OPTION must be RANGE, not VALUE" where the condition does not hold.
void require(bool condition, const char* option, const char* range, double value);

// Throws the same where an option is out of its range.
void check(const RayOptions& options);

}  // namespace lkao::lut
