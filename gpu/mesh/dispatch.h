// Compute shaders with an invocation for each of many things.
#pragma once

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>

#include "gpu/mesh/draw_words.h"

namespace lkao::gl {

// In groups of LKAO_GROUP_SIZE, in rows of groups: no count may be larger than 65535. The shader finds its number as
// (y * columns + x) * LKAO_GROUP_SIZE + its place in the group, and ends where that is too large.
inline void dispatch_for_each(std::size_t count) {
  const std::size_t group_count = (count + LKAO_GROUP_SIZE - 1) / LKAO_GROUP_SIZE;
  const std::size_t columns = std::min<std::size_t>(group_count, 32768);
  glDispatchCompute(static_cast<GLuint>(columns), static_cast<GLuint>((group_count + columns - 1) / columns), 1);
}

}  // namespace lkao::gl
