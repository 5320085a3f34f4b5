#include "gpu/gl/state_keeper.h"

#include <algorithm>
#include <stdexcept>

namespace lkao::gl {
namespace {

GLenum binding_of(GLenum target) {
  switch (target) {
    case GL_TEXTURE_2D:
      return GL_TEXTURE_BINDING_2D;
    case GL_TEXTURE_2D_ARRAY:
      return GL_TEXTURE_BINDING_2D_ARRAY;
    case GL_TEXTURE_BUFFER:
      return GL_TEXTURE_BINDING_BUFFER;
    default:
      throw std::logic_error("no pass binds textures of such a target");
  }
}

GLint get(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

GLint get(GLenum name, GLuint index) {
  GLint value = 0;
  glGetIntegeri_v(name, index, &value);
  return value;
}

GLuint name_of(GLint value) { return static_cast<GLuint>(value); }
GLenum enum_of(GLint value) { return static_cast<GLenum>(value); }

void enable(GLenum capability, bool is_on) {
  if (is_on) {
    glEnable(capability);
  } else {
    glDisable(capability);
  }
}

template <typename Buffer>
Buffer indexed_buffer(GLenum binding, GLenum start, GLenum size, GLuint index) {
  Buffer buffer{get(binding, index), 0, 0};
  glGetInteger64i_v(start, index, &buffer.start);
  glGetInteger64i_v(size, index, &buffer.size);
  return buffer;
}

template <typename Buffer>
void restore(GLenum target, GLuint index, const Buffer& buffer) {
  // A size of 0 says that the whole buffer was bound.
  if (buffer.name != 0 && buffer.size != 0) {
    glBindBufferRange(target, index, name_of(buffer.name), buffer.start, buffer.size);
  } else {
    glBindBufferBase(target, index, name_of(buffer.name));
  }
}

}  // namespace

StateKeeper::StateKeeper(const StateUse& use, bool keeps) : use_(use), keeps_(keeps) {
  if (keeps_) {
    program_ = get(GL_CURRENT_PROGRAM);
    vertex_array_ = get(GL_VERTEX_ARRAY_BINDING);
    save_textures();
    save_buffers();
    if (use_.moves_pixels) save_pixel_moves();
    if (use_.draws) save_pipeline();
  }
  set_defaults();
}

StateKeeper::~StateKeeper() {
  if (!keeps_) return;
  if (use_.draws) restore_pipeline();
  if (use_.moves_pixels) restore_pixel_moves();
  restore_buffers();
  restore_textures();
  glBindVertexArray(name_of(vertex_array_));
  // A program that its owner deleted while it was in use is gone by now.
  glUseProgram(glIsProgram(name_of(program_)) == GL_TRUE ? name_of(program_) : 0);
}

void StateKeeper::save_textures() {
  active_unit_ = get(GL_ACTIVE_TEXTURE);
  for (std::size_t unit = 0; unit < use_.texture_targets.size(); ++unit) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    textures_.push_back(get(binding_of(use_.texture_targets[unit])));
    samplers_.push_back(get(GL_SAMPLER_BINDING));
  }
  for (GLuint i = 0; i < use_.image_count; ++i) {
    images_.push_back({get(GL_IMAGE_BINDING_NAME, i), get(GL_IMAGE_BINDING_LEVEL, i), get(GL_IMAGE_BINDING_LAYERED, i),
                       get(GL_IMAGE_BINDING_LAYER, i), get(GL_IMAGE_BINDING_ACCESS, i),
                       get(GL_IMAGE_BINDING_FORMAT, i)});
  }
}

void StateKeeper::restore_textures() const {
  for (std::size_t unit = 0; unit < textures_.size(); ++unit) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(use_.texture_targets[unit], name_of(textures_[unit]));
    glBindSampler(static_cast<GLuint>(unit), name_of(samplers_[unit]));
  }
  glActiveTexture(enum_of(active_unit_));
  for (GLuint i = 0; i < images_.size(); ++i) {
    const ImageUnit& image = images_[i];
    glBindImageTexture(i, name_of(image.name), image.level, static_cast<GLboolean>(image.is_layered), image.layer,
                       enum_of(image.access), enum_of(image.format));
  }
}

void StateKeeper::save_buffers() {
  uniform_buffer_ = get(GL_UNIFORM_BUFFER_BINDING);
  storage_buffer_ = get(GL_SHADER_STORAGE_BUFFER_BINDING);
  counter_buffer_ = get(GL_ATOMIC_COUNTER_BUFFER_BINDING);
  for (GLuint i = 0; i < use_.block_count; ++i) {
    blocks_.push_back(
        indexed_buffer<IndexedBuffer>(GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE, i));
  }
  for (GLuint i = 0; i < use_.storage_count; ++i) {
    storage_.push_back(indexed_buffer<IndexedBuffer>(GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START,
                                                     GL_SHADER_STORAGE_BUFFER_SIZE, i));
  }
  if (use_.counts) {
    counters_ = indexed_buffer<IndexedBuffer>(GL_ATOMIC_COUNTER_BUFFER_BINDING, GL_ATOMIC_COUNTER_BUFFER_START,
                                              GL_ATOMIC_COUNTER_BUFFER_SIZE, 0);
  }
}

void StateKeeper::restore_buffers() const {
  for (GLuint i = 0; i < blocks_.size(); ++i) restore(GL_UNIFORM_BUFFER, i, blocks_[i]);
  for (GLuint i = 0; i < storage_.size(); ++i) restore(GL_SHADER_STORAGE_BUFFER, i, storage_[i]);
  if (use_.counts) restore(GL_ATOMIC_COUNTER_BUFFER, 0, counters_);
  // After the indexed ones, which change these as well.
  glBindBuffer(GL_UNIFORM_BUFFER, name_of(uniform_buffer_));
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, name_of(storage_buffer_));
  glBindBuffer(GL_ATOMIC_COUNTER_BUFFER, name_of(counter_buffer_));
}

void StateKeeper::save_pixel_moves() {
  pack_buffer_ = get(GL_PIXEL_PACK_BUFFER_BINDING);
  unpack_buffer_ = get(GL_PIXEL_UNPACK_BUFFER_BINDING);
  for (const PixelStore& parameter : kKeptPixelStore) pixel_store_.push_back(get(parameter.name));
}

void StateKeeper::restore_pixel_moves() const {
  glBindBuffer(GL_PIXEL_PACK_BUFFER, name_of(pack_buffer_));
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, name_of(unpack_buffer_));
  for (std::size_t i = 0; i < pixel_store_.size(); ++i) glPixelStorei(kKeptPixelStore[i].name, pixel_store_[i]);
}

void StateKeeper::save_pipeline() {
  draw_framebuffer_ = get(GL_DRAW_FRAMEBUFFER_BINDING);
  read_framebuffer_ = get(GL_READ_FRAMEBUFFER_BINDING);
  indirect_buffer_ = get(GL_DRAW_INDIRECT_BUFFER_BINDING);
  for (GLenum capability : kKeptCapabilities) capabilities_.push_back(glIsEnabled(capability));
  has_scissor_ = glIsEnabledi(GL_SCISSOR_TEST, 0);
  glGetFloati_v(GL_VIEWPORT, 0, viewport_.data());
  glGetDoublei_v(GL_DEPTH_RANGE, 0, depth_range_.data());
  for (GLuint i = 0; i < kKeptColorCount; ++i) {
    ColorState& color = colors_.emplace_back();
    glGetBooleani_v(GL_COLOR_WRITEMASK, i, color.mask.data());
    if (!use_.blends) continue;
    color.is_blended = glIsEnabledi(GL_BLEND, i);
    std::transform(std::begin(kKeptBlending), std::end(kKeptBlending), color.blending.begin(),
                   [i](GLenum name) { return get(name, i); });
  }
  glGetBooleanv(GL_DEPTH_WRITEMASK, &depth_mask_);
  depth_function_ = get(GL_DEPTH_FUNC);
  cull_mode_ = get(GL_CULL_FACE_MODE);
  front_face_ = get(GL_FRONT_FACE);
  logic_operation_ = get(GL_LOGIC_OP_MODE);
  clip_origin_ = get(GL_CLIP_ORIGIN);
  clip_depth_ = get(GL_CLIP_DEPTH_MODE);
  glGetIntegerv(GL_POLYGON_MODE, polygon_mode_.data());
}

void StateKeeper::set_defaults() const {
  for (std::size_t unit = 0; unit < use_.texture_targets.size(); ++unit) glBindSampler(static_cast<GLuint>(unit), 0);
  if (use_.moves_pixels) {
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    for (const PixelStore& parameter : kKeptPixelStore) glPixelStorei(parameter.name, parameter.tight);
  }
  if (!use_.draws) return;
  for (GLenum capability : kKeptCapabilities) glDisable(capability);
  glDisablei(GL_SCISSOR_TEST, 0);
  glDepthRangeIndexed(0, 0.0, 1.0);
  for (GLuint i = 0; i < kKeptColorCount; ++i) {
    glColorMaski(i, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    if (use_.blends) glDisablei(GL_BLEND, i);
  }
  glDepthMask(GL_FALSE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
}

void StateKeeper::restore_pipeline() const {
  for (std::size_t i = 0; i < capabilities_.size(); ++i) enable(kKeptCapabilities[i], capabilities_[i] == GL_TRUE);
  if (has_scissor_ == GL_TRUE) glEnablei(GL_SCISSOR_TEST, 0);
  glViewportIndexedf(0, viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
  glDepthRangeIndexed(0, depth_range_[0], depth_range_[1]);
  for (GLuint i = 0; i < colors_.size(); ++i) {
    const auto& [mask, is_blended, blending] = colors_[i];
    glColorMaski(i, mask[0], mask[1], mask[2], mask[3]);
    if (!use_.blends) continue;
    if (is_blended == GL_TRUE) {
      glEnablei(GL_BLEND, i);
    } else {
      glDisablei(GL_BLEND, i);
    }
    glBlendFuncSeparatei(i, enum_of(blending[0]), enum_of(blending[1]), enum_of(blending[2]), enum_of(blending[3]));
    glBlendEquationSeparatei(i, enum_of(blending[4]), enum_of(blending[5]));
  }
  glDepthMask(depth_mask_);
  glDepthFunc(enum_of(depth_function_));
  glCullFace(enum_of(cull_mode_));
  glFrontFace(enum_of(front_face_));
  glLogicOp(enum_of(logic_operation_));
  glClipControl(enum_of(clip_origin_), enum_of(clip_depth_));
  glPolygonMode(GL_FRONT_AND_BACK, enum_of(polygon_mode_[0]));
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, name_of(draw_framebuffer_));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, name_of(read_framebuffer_));
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, name_of(indirect_buffer_));
}

}  // namespace lkao::gl
