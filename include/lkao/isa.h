// Which SIMD instruction sets are compiled in, and which one runs.
#pragma once

#include <string>
#include <vector>

#include "lkao/export.h"
#include "lkao/requirements.h"

namespace lkao {

// The instruction sets that are compiled in and that this processor has, best first, by Highway's names in lower case:
// "avx3" (AVX-512), "avx2", "sse4"; "neon" on ARM.
LKAO_API std::vector<std::string> available_isas();

// The one that runs: the best, or what was forced.
LKAO_API std::string active_isa();

// Uses the named instruction set from now on, in every thread; "avx512" is another name for "avx3", and "" takes the
// force away. Results do not depend on it, nor does any other user of Highway in the process: this is for tests and
// benchmarks. The environment variable LKAO_ISA does the same before the first query. Not to be called while queries
// run. Throws std::invalid_argument naming what is available.
LKAO_API void force_isa(const std::string& name);

}  // namespace lkao
