// Which lkao this is, at compile time and at run time.
#pragma once

#include "lkao/export.h"
#include "lkao/requirements.h"

// Before 1.0, a new minor version may break programs and their binaries; find_package and the shared libraries' names
// (liblkao.so.0.1) know it. CMakeLists.txt reads the three numbers here.
#define LKAO_VERSION_MAJOR 0
#define LKAO_VERSION_MINOR 1
#define LKAO_VERSION_PATCH 0

// For comparisons: LKAO_VERSION >= LKAO_MAKE_VERSION(0, 2, 0).
#define LKAO_MAKE_VERSION(major, minor, patch) ((major)*10000 + (minor)*100 + (patch))
#define LKAO_VERSION LKAO_MAKE_VERSION(LKAO_VERSION_MAJOR, LKAO_VERSION_MINOR, LKAO_VERSION_PATCH)

namespace lkao {

// Of the library that is linked, "0.1.0": other numbers than the macros' tell of headers and a library that do not
// belong together. The library itself uses no Embree; which one the program measures against is what `lkao --version`
// says.
LKAO_API const char* version();

}  // namespace lkao
