// The scalar exact kernel: the readable definition of a query's result.
#pragma once

#include "bvh/layout.h"
#include "bvh/query.h"
#include "bvh/scene_layout.h"

namespace lkao::bvh {

// Which of the cast rays are blocked. Allocates nothing; any thread.
OcclusionMask trace_scalar(const Layout& layout, const Query& query);
OcclusionMask trace_scalar(const SceneLayout& scene, const Query& query);

}  // namespace lkao::bvh
