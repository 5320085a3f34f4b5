// Which SIMD instruction set runs (lkao/isa.h).
#pragma once

#include "lkao/c/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// Those that are compiled in and that this processor has, best first: "avx3", "avx2", "sse4"; NULL from some i on.
LKAO_C_API const char* lkao_available_isa(size_t i);
// The one that runs; NULL where the environment variable LKAO_ISA names one that there is not.
LKAO_C_API const char* lkao_active_isa(void);
// Uses that one from now on, in every thread; "" or NULL: the best. For tests and benchmarks; not while queries run.
LKAO_C_API lkao_status lkao_force_isa(const char* name);

#ifdef __cplusplus
}
#endif
