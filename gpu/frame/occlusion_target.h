// Where a pass writes occlusion; gpu/frame/target.glsl writes it.
#pragma once

#include "gpu/frame/target_block.h"
#include "gpu/gl/objects.h"
#include "gpu/gl/uniform_buffer.h"
#include "lkao/gl/frame.h"

namespace lkao::gl {

// Throws std::invalid_argument naming the texture and its fault. `width` and `height` are those of the picture.
void validate(const OcclusionTarget& target, int width, int height);

// The same for a target that is read.
void validate_source(const OcclusionTarget& source, int width, int height);

// Requires validate(). Without a texture only the block is set.
void bind(const OcclusionTarget& target, const UniformBuffer<TargetBlock>& block, const Sampler& plain_sampler);

// From 0 to 1, of each component of a texture of normalised numbers; 0 of others. For at_nearest_step() of the shader.
glm::vec4 steps_to_one(ObjectName texture);

// For writing by a shader.
void bind_image(unsigned unit, ObjectName texture);

// Before and after shaders write to textures of the caller: what read or drew to them comes first, what reads them next
// sees all of it.
void begin_writing_targets();
void end_writing_targets();

}  // namespace lkao::gl
