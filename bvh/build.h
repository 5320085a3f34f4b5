// From a mesh to a finished hierarchy.
#pragma once

#include <cstddef>
#include <memory>

#include "bvh/layout.h"

namespace lkao::bvh {

// As OccluderBvh's constructor says.
std::shared_ptr<Layout> build(const TriangleMesh& mesh, const BuildOptions& options, const Progress& progress);

// What the report of a finished layout says of it.
std::size_t memory_bytes(const Layout& layout);

}  // namespace lkao::bvh
