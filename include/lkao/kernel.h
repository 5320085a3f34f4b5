// Ways to answer a query on the CPU.
#pragma once

#include "lkao/requirements.h"

namespace lkao {

// What answers a query ray by ray; the bits are the same.
enum class Kernel {
  simd,    // vectors of the fastest instruction set that the processor has
  scalar,  // the readable definition of the result
};

// How the table kernel finds the rays that may meet a node (Laine & Karras 2010, Sec. 5).
enum class NodeMasks {
  bounding_sphere,  // one or two look-ups (Figure 4)
  box_outline,      // tighter, faster on CPUs: a look-up for each edge of the box's outline and each face seen
};

}  // namespace lkao
