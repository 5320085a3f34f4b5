// The caller's G-buffer, for any pass; gpu/frame/g_buffer.glsl reads it.
#pragma once

#include "gpu/frame/view.h"
#include "gpu/frame/view_block.h"
#include "gpu/gl/objects.h"
#include "lkao/gl/frame.h"

namespace lkao::gl {

// Throws std::invalid_argument naming the texture and its fault.
void validate(const GBuffer& g_buffer);

// The one texture that says where pixels lie. Requires validate().
inline ObjectName place_of(const GBuffer& g_buffer) {
  return g_buffer.depth + g_buffer.linear_depth + g_buffer.positions;
}

inline Pixels pixels_of(const GBuffer& g_buffer) { return {g_buffer.width, g_buffer.height, g_buffer.step}; }

// What shaders need to know of camera and G-buffer. Requires validate(). Throws std::invalid_argument where the
// camera's `view` is no rigid motion or its `projection` neither perspective nor orthographic.
ViewBlock make_view_block(const GBuffer& g_buffer, const Camera& camera);

// Binds the textures and a sampler that reads them as they are.
void bind(const GBuffer& g_buffer, const Sampler& plain_sampler);

}  // namespace lkao::gl
