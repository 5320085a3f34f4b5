// Where neighbouring receivers enter the hierarchy.
#pragma once

#include "bvh/layout.h"

namespace lkao::bvh {

// A node over all that rays of the length `radius` can meet from origins within `origins`: its children are up to 8
// nodes and leaves from as deep in the hierarchy as that allows. Receivers near one another share what is above; where
// they are far apart, or the radius is large, it is little better than the root.
Node make_entry_node(const Layout& layout, const Bounds& origins, float radius);

}  // namespace lkao::bvh
