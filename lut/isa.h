// Which instruction set runs: for what is compiled for several (Highway's targets).
#pragma once

#include <hwy/highway.h>

#include "lkao/export.h"

namespace lkao::lut {

// lkao's own choice: what is forced here changes nothing for other users of Highway in the process.
LKAO_API hwy::ChosenTarget& chosen_target();

// Obeys the environment variable LKAO_ISA, once a process. To be called before any dispatch. Throws as force_isa.
LKAO_API void obey_isa_environment();

}  // namespace lkao::lut

// HWY_DYNAMIC_DISPATCH by that choice; as it, after HWY_EXPORT.
#if HWY_IDE || ((HWY_TARGETS & (HWY_TARGETS - 1)) == 0)
#define LKAO_DISPATCH(FUNCTION) HWY_STATIC_DISPATCH(FUNCTION)
#else
#define LKAO_DISPATCH(FUNCTION) (*(HWY_DISPATCH_TABLE(FUNCTION)[lkao::lut::chosen_target().GetIndex()]))
#endif
