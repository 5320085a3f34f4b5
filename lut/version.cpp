#include "lkao/version.h"

#define LKAO_TEXT_OF(number) #number
#define LKAO_TEXT(major, minor, patch) LKAO_TEXT_OF(major) "." LKAO_TEXT_OF(minor) "." LKAO_TEXT_OF(patch)

namespace lkao {

const char* version() { return LKAO_TEXT(LKAO_VERSION_MAJOR, LKAO_VERSION_MINOR, LKAO_VERSION_PATCH); }

}  // namespace lkao
