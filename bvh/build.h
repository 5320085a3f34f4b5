// From a mesh to a finished hierarchy.
#pragma once

#include <memory>

#include "bvh/layout.h"

namespace lkao::bvh {

// As OccluderBvh's constructor says.
std::shared_ptr<const Layout> build(const TriangleMesh& mesh, const BuildOptions& options, const Progress& progress);

}  // namespace lkao::bvh
