// Is a G-buffer, or a target, what it should be?
#pragma once

#include "gpu/pass_uniforms.h"
#include "lkao/gl.h"

namespace lkao::gl {

// Throws std::invalid_argument naming the texture and its fault.
void validate(const GBuffer& g_buffer);
void validate(const ResolveTargets& targets, int width, int height);

// Binds the textures; sets the uniforms that hang on them. Requires validate().
void bind(const GBuffer& g_buffer, const Camera& camera, PassUniforms& uniforms);

// The internal format of level 0 of a texture.
unsigned format_of(ObjectName texture);

}  // namespace lkao::gl
