// Which lkao this is, at compile time and at run time.
#pragma once

#include "lkao/export.h"
#include "lkao/requirements.h"
#include "lkao/version_numbers.h"

namespace lkao {

// Of the library that is linked, "0.1.0": other numbers than the macros' tell of headers and a library that do not
// belong together. The library itself uses no Embree; which one the program measures against is what `lkao --version`
// says.
LKAO_API const char* version();

}  // namespace lkao
