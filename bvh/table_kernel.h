// The paper's method 2 on the CPU: node and triangle masks by look-ups in the plane mask table.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 3.1 and 5.
#pragma once

#include "bvh/layout.h"
#include "bvh/query.h"
#include "bvh/scene_layout.h"
#include "lkao/kernel.h"
#include "lkao/plane_mask_table.h"

namespace lkao::bvh {

// Which of the cast rays are blocked: exactly with a must/may table, where only the rays in doubt are tested one by
// one, approximately with nearest cells. The rays of the query are the table's pattern, turned, and whole. Allocates
// nothing; any thread.
OcclusionMask trace_table(const Layout& layout, const Query& query, const PlaneMaskTable& table, NodeMasks node_masks);
OcclusionMask trace_table(const SceneLayout& scene, const Query& query, const PlaneMaskTable& table,
                          NodeMasks node_masks);

}  // namespace lkao::bvh
