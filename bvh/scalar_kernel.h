// The scalar exact kernel: the readable definition of a query's result.
#pragma once

#include "bvh/layout.h"
#include "bvh/query.h"

namespace lkao::bvh {

// Which of the cast rays are blocked. Allocates nothing; any thread.
OcclusionMask trace_scalar(const Layout& layout, const Query& query);

}  // namespace lkao::bvh
