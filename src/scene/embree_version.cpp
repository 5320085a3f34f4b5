#include "scene/embree_version.h"

#include "scene/embree.h"

namespace lkao::scene {

const char* embree_version() { return RTC_VERSION_STRING; }

}  // namespace lkao::scene
