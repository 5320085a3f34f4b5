// From the builder's tree to the layout that is traversed.
#pragma once

#include "bvh/build_tree.h"
#include "bvh/layout.h"

namespace lkao::bvh {

// Fills nodes and leaves of the layout, in parallel; its mesh and bounds are there already. Both are numbered depth
// first, so that subtrees lie together.
void flatten(const BuildTree& root, Layout& layout);

}  // namespace lkao::bvh
