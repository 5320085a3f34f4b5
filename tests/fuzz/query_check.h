// Whether all ways to answer a query give the same bits.
#pragma once

#include <string>

#include "fuzz/query_case.h"

namespace lkao::tests {

// Empty where all agree: every triangle tried with the definition of a hit (TriangleTest), the scalar kernel, the SIMD
// kernel on every instruction set of this processor, the table kernel where the case has a table; one by one and as a
// batch; masks, occlusion and bent normals. Otherwise which two do not, for which receiver and rays, in a few lines.
// In wild cases kernels may differ, but each must agree with itself, and block no ray that is not cast.
std::string find_difference(const QueryCase& c);

}  // namespace lkao::tests
