// What the CPU and the OpenGL side check of a mesh before they take it.
#pragma once

#include <cstddef>

#include "lkao/export.h"
#include "lkao/index_view.h"

namespace lkao::lut {

// Throws std::invalid_argument, naming the first triangle with an index that no position has, and that index.
LKAO_API void check_indices(const IndexView& triangles, std::size_t position_count);

}  // namespace lkao::lut
