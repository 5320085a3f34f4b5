// The one wording of errors about arguments out of range.
#pragma once

#include "lkao/export.h"

namespace lkao::lut {

// Throws std::invalid_argument "OPTION must be RANGE, not VALUE" where the condition does not hold.
LKAO_API void require(bool condition, const char* option, const char* range, double value);

}  // namespace lkao::lut
