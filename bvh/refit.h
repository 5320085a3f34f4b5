// New positions for the triangles of a finished hierarchy.
#pragma once

#include <memory>

#include "bvh/layout.h"

namespace lkao::bvh {

// As OccluderBvh::refitted says.
std::shared_ptr<const Layout> refit(const Layout& old, const PositionView& positions, const RefitOptions& options,
                                    const Progress& progress);

}  // namespace lkao::bvh
