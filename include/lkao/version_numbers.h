// Which lkao this is, for programs in C and in C++. CMakeLists.txt reads the three numbers here.
#pragma once

// Before 1.0, a new minor version may break programs and their binaries; find_package and the shared libraries' names
// (liblkao.so.0.1) know it. The C interface promises more (lkao/c.h).
#define LKAO_VERSION_MAJOR 0
#define LKAO_VERSION_MINOR 1
#define LKAO_VERSION_PATCH 0

// For comparisons: LKAO_VERSION >= LKAO_MAKE_VERSION(0, 2, 0).
#define LKAO_MAKE_VERSION(major, minor, patch) ((major)*10000 + (minor)*100 + (patch))
#define LKAO_VERSION LKAO_MAKE_VERSION(LKAO_VERSION_MAJOR, LKAO_VERSION_MINOR, LKAO_VERSION_PATCH)
