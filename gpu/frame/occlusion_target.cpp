#include "gpu/frame/occlusion_target.h"

#include <epoxy/gl.h>

#include "gpu/frame/texture_checks.h"

namespace lkao::gl {

void validate(const OcclusionTarget& target, int width, int height) {
  require_size("occlusion", target.texture, width, height);
  require_format("occlusion", target.texture, "GL_R8, GL_R16, GL_R16F and GL_R32F", {GL_R8, GL_R16, GL_R16F, GL_R32F});
}

void bind_image(unsigned unit, ObjectName texture) {
  glBindImageTexture(unit, texture, 0, GL_FALSE, 0, GL_WRITE_ONLY, format_of(texture));
}

void begin_writing_targets() { glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT); }

void end_writing_targets() {
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT |
                  GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_PIXEL_BUFFER_BARRIER_BIT);
}

}  // namespace lkao::gl
