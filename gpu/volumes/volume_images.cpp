#include "gpu/volumes/volume_images.h"

#include <array>
#include <stdexcept>

#include <fmt/format.h>

#include "gpu/frame/grown_size.h"
#include "gpu/gl/error.h"
#include "gpu/volumes/units.h"

namespace lkao::gl {
namespace {

Texture make_image(GLenum format, int width, int height) {
  Texture texture = make_texture(GL_TEXTURE_2D);
  glTextureStorage2D(texture.name(), 1, format, width, height);
  return texture;
}

GLenum image_format_of(Accessibility format) {
  switch (format) {
    case Accessibility::bits8:
      return GL_R8;
    case Accessibility::bits16:
      return GL_R16;
    case Accessibility::bits32:
      break;
  }
  return GL_R32F;
}

void require_complete(const Framebuffer& framebuffer, int width, int height) {
  const GLenum status = glCheckNamedFramebufferStatus(framebuffer.name(), GL_DRAW_FRAMEBUFFER);
  if (status == GL_FRAMEBUFFER_COMPLETE) return;
  throw std::runtime_error(
      fmt::format("this OpenGL cannot draw to images of {}x{} (status {:#x})", width, height, status));
}

void bind_texture(GLuint unit, const Texture& texture, const Sampler& sampler) {
  if (!texture) return;  // 0 would unbind textures of all targets
  glBindTextureUnit(unit, texture.name());
  glBindSampler(unit, sampler.name());
}

}  // namespace

void VolumeImages::make_room(int width, int height, Accessibility format, bool with_ups) {
  const bool fits = width <= texture_width_ && height <= texture_height_ && with_ups == static_cast<bool>(ups_);
  if (!fits) {
    const Size size = grown_size({width, height}, {texture_width_, texture_height_});
    // The old ones first: there may not be room for both.
    *this = VolumeImages();
    allocate(size.width, size.height, format, with_ups);
  }
  width_ = width;
  height_ = height;
}

void VolumeImages::allocate(int width, int height, Accessibility format, bool with_ups) {
  origins_ = make_image(GL_RGBA32F, width, height);
  axes_ = make_image(GL_RGBA32F, width, height);
  if (with_ups) ups_ = make_image(GL_RGBA32F, width, height);
  depth_ = make_image(GL_DEPTH_COMPONENT32F, width, height);
  accessibility_ = make_image(image_format_of(format), width, height);
  receivers_framebuffer_ = make_framebuffer();
  accessibility_framebuffer_ = make_framebuffer();
  const std::array<GLenum, 3> attachments = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2};
  const GLuint receivers = receivers_framebuffer_.name(), result = accessibility_framebuffer_.name();
  glNamedFramebufferTexture(receivers, attachments[0], origins_.name(), 0);
  glNamedFramebufferTexture(receivers, attachments[1], axes_.name(), 0);
  if (with_ups) glNamedFramebufferTexture(receivers, attachments[2], ups_.name(), 0);
  glNamedFramebufferTexture(receivers, GL_DEPTH_ATTACHMENT, depth_.name(), 0);
  glNamedFramebufferDrawBuffers(receivers, with_ups ? 3 : 2, attachments.data());
  glNamedFramebufferTexture(result, attachments[0], accessibility_.name(), 0);
  glNamedFramebufferTexture(result, GL_DEPTH_ATTACHMENT, depth_.name(), 0);
  check_errors("making the images of volumes");
  require_complete(receivers_framebuffer_, width, height);
  require_complete(accessibility_framebuffer_, width, height);
  texture_width_ = width;
  texture_height_ = height;
}

void VolumeImages::bind_framebuffer(const Framebuffer& framebuffer) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  glViewportIndexedf(0, 0.0f, 0.0f, static_cast<GLfloat>(width_), static_cast<GLfloat>(height_));
}

void VolumeImages::bind_receivers() const { bind_framebuffer(receivers_framebuffer_); }

void VolumeImages::bind_accessibility(const Sampler& plain_sampler) const {
  bind_texture(LKAO_UNIT_ORIGINS, origins_, plain_sampler);
  bind_texture(LKAO_UNIT_AXES, axes_, plain_sampler);
  bind_texture(LKAO_UNIT_UPS, ups_, plain_sampler);
  bind_framebuffer(accessibility_framebuffer_);
  const GLfloat all[4] = {1, 1, 1, 1};
  glClearNamedFramebufferfv(accessibility_framebuffer_.name(), GL_COLOR, 0, all);
}

void VolumeImages::bind_result(const Sampler& plain_sampler) const {
  bind_texture(LKAO_UNIT_ORIGINS, origins_, plain_sampler);
  bind_texture(LKAO_UNIT_ACCESSIBILITY, accessibility_, plain_sampler);
}

}  // namespace lkao::gl
