// For what dispatches to SIMD targets.
#pragma once

namespace lkao::lut {

// Obeys the environment variable LKAO_ISA, once a process. To be called before any dispatch. Throws as force_isa.
void obey_isa_environment();

}  // namespace lkao::lut
