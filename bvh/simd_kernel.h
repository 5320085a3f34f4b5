// The vector kernel: the bits of the scalar exact kernel, 16 rays or 8 boxes or triangles at a time.
#pragma once

#include "bvh/layout.h"
#include "bvh/pattern_cones.h"
#include "bvh/query.h"

namespace lkao::bvh {

// Which of the cast rays are blocked: equal to trace_scalar bit for bit on every SIMD target. The fastest target that
// the processor has is chosen at run time. `cones`: of the pattern, before rays.frame turns it. Allocates nothing; any
// thread.
OcclusionMask trace_simd(const Layout& layout, const Query& query, const PatternCones& cones);

}  // namespace lkao::bvh
