// Where a pass writes occlusion.
#pragma once

#include "lkao/gl/frame.h"

namespace lkao::gl {

// Throws std::invalid_argument naming the texture and its fault.
void validate(const OcclusionTarget& target, int width, int height);

// For writing by a shader.
void bind_image(unsigned unit, ObjectName texture);

// Before and after shaders write to textures of the caller: what read or drew to them comes first, what reads them next
// sees all of it.
void begin_writing_targets();
void end_writing_targets();

}  // namespace lkao::gl
