#include "gpu/masks/mask_images.h"

#include <fmt/format.h>

#include <cstddef>
#include <stdexcept>

#include "gpu/frame/grown_size.h"
#include "gpu/gl/error.h"

namespace lkao::gl {
namespace {

Texture make_layers(GLenum format, int width, int height, int layer_count) {
  Texture texture = make_texture(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(texture.name(), 1, format, width, height, layer_count);
  return texture;
}

void require_storage(int width, int height) {
  GLint64 largest = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &largest);
  if (GLint64{16} * width * height > largest) {
    throw std::runtime_error(
        fmt::format("{}x{} pixels need more shader storage than this OpenGL's {} bytes a block: use the logic op",
                    width, height, largest));
  }
}

}  // namespace

void MaskImages::make_room(int width, int height, int layer_count, bool with_storage) {
  if (with_storage) require_storage(width, height);
  const bool fits = width <= texture_width_ && height <= texture_height_ && layer_count == layer_count_;
  if (!fits) {
    const Size size = grown_size({width, height}, {texture_width_, texture_height_});
    // The old ones first: there may not be room for both.
    *this = MaskImages();
    allocate(size.width, size.height, layer_count, with_storage);
  }
  width_ = width;
  height_ = height;
}

void MaskImages::allocate(int width, int height, int layer_count, bool with_storage) {
  layer_count_ = layer_count;
  receivers_ = make_layers(GL_RGBA32F, width, height, LKAO_RECEIVER_LAYER_COUNT);
  masks_ = make_layers(GL_RGBA32UI, width, height, layer_count);
  depth_ = make_texture(GL_TEXTURE_2D);
  glTextureStorage2D(depth_.name(), 1, GL_DEPTH_COMPONENT32F, width, height);
  framebuffer_ = make_framebuffer();
  glNamedFramebufferTexture(framebuffer_.name(), GL_DEPTH_ATTACHMENT, depth_.name(), 0);
  if (with_storage) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(layer_count); ++k) {
      storage_[k] = make_buffer(GLsizeiptr{16} * width * height, nullptr, 0);
    }
  } else {
    attach_masks();
  }
  check_errors("making the occlusion buffers");
  const GLenum status = glCheckNamedFramebufferStatus(framebuffer_.name(), GL_DRAW_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    throw std::runtime_error(fmt::format("this OpenGL cannot draw to {} integer attachments of {}x{} (status {:#x})",
                                         layer_count, width, height, status));
  }
  texture_width_ = width;
  texture_height_ = height;
}

void MaskImages::attach_masks() const {
  std::array<GLenum, 8> attachments{};
  for (int k = 0; k < layer_count_; ++k) {
    const GLenum attachment = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(k);
    glNamedFramebufferTextureLayer(framebuffer_.name(), attachment, masks_.name(), 0, k);
    attachments[static_cast<std::size_t>(k)] = attachment;
  }
  glNamedFramebufferDrawBuffers(framebuffer_.name(), layer_count_, attachments.data());
}

void MaskImages::bind_depth() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewportIndexedf(0, 0.0f, 0.0f, static_cast<GLfloat>(width_), static_cast<GLfloat>(height_));
}

void MaskImages::bind_masks() const {
  bind_depth();
  const GLuint zeros[4] = {0, 0, 0, 0};
  if (!storage_[0]) {
    glClearTexSubImage(masks_.name(), 0, 0, 0, 0, width_, height_, layer_count_, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                       zeros);
    return;
  }
  const GLsizeiptr size = GLsizeiptr{16} * width_ * height_;
  for (int k = 0; k < layer_count_; ++k) {
    const GLuint buffer = storage_[static_cast<std::size_t>(k)].name();
    glClearNamedBufferSubData(buffer, GL_RGBA32UI, 0, size, GL_RGBA_INTEGER, GL_UNSIGNED_INT, zeros);
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(LKAO_STORAGE_MASKS + k), buffer, 0, size);
  }
}

void MaskImages::finish_masks() const {
  if (!storage_[0]) return;
  glMemoryBarrier(GL_PIXEL_BUFFER_BARRIER_BIT);
  for (int k = 0; k < layer_count_; ++k) {
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, storage_[static_cast<std::size_t>(k)].name());
    glTextureSubImage3D(masks_.name(), 0, 0, 0, k, width_, height_, 1, GL_RGBA_INTEGER, GL_UNSIGNED_INT, nullptr);
  }
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
}

}  // namespace lkao::gl
