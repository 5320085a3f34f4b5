// A hard case against the oracle.
#pragma once

#include <string>

#include "hard_case.h"

namespace lkao::tests {

// Expects the bits of the scalar kernel from the default kernel, from every instruction set and from exact look-ups,
// and no difference from the oracle but within rounding. Prints one row: rays, and those that the library and its
// rivals answer differently from the oracle. Embree's rays are closed at the origin: those that start on a triangle are
// extra.
void check(const std::string& name, const HardCase& hard_case);

}  // namespace lkao::tests
