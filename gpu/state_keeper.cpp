#include "gpu/state_keeper.h"

namespace lkao::gl {
namespace {

struct Unit {
  GLenum target, binding;
};

// The one target of each texture unit that the passes use.
Unit target_of(std::size_t unit) {
  switch (unit) {
    case LKAO_UNIT_RECEIVERS:
    case LKAO_UNIT_MASKS:
      return {GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BINDING_2D_ARRAY};
    case LKAO_UNIT_PLACE:
    case LKAO_UNIT_NORMALS:
    case LKAO_UNIT_GEOMETRIC_NORMALS:
      return {GL_TEXTURE_2D, GL_TEXTURE_BINDING_2D};
    default:
      return {GL_TEXTURE_BUFFER, GL_TEXTURE_BINDING_BUFFER};
  }
}

// All are off while a pass begins.
constexpr GLenum kCapabilities[] = {GL_DEPTH_TEST,
                                    GL_STENCIL_TEST,
                                    GL_CULL_FACE,
                                    GL_DEPTH_CLAMP,
                                    GL_COLOR_LOGIC_OP,
                                    GL_POLYGON_OFFSET_FILL,
                                    GL_POLYGON_SMOOTH,
                                    GL_RASTERIZER_DISCARD,
                                    GL_SAMPLE_MASK,
                                    GL_SAMPLE_COVERAGE,
                                    GL_SAMPLE_ALPHA_TO_COVERAGE,
                                    GL_PRIMITIVE_RESTART,
                                    GL_PRIMITIVE_RESTART_FIXED_INDEX,
                                    GL_CLIP_DISTANCE0,
                                    GL_CLIP_DISTANCE1,
                                    GL_CLIP_DISTANCE2,
                                    GL_CLIP_DISTANCE3,
                                    GL_CLIP_DISTANCE4,
                                    GL_CLIP_DISTANCE5,
                                    GL_CLIP_DISTANCE6,
                                    GL_CLIP_DISTANCE7};

struct PixelStore {
  GLenum name;
  GLint tight;
};
constexpr PixelStore kPixelStore[] = {
    {GL_PACK_SWAP_BYTES, 0},    {GL_PACK_ROW_LENGTH, 0},     {GL_PACK_IMAGE_HEIGHT, 0},  {GL_PACK_SKIP_PIXELS, 0},
    {GL_PACK_SKIP_ROWS, 0},     {GL_PACK_SKIP_IMAGES, 0},    {GL_PACK_ALIGNMENT, 4},     {GL_UNPACK_SWAP_BYTES, 0},
    {GL_UNPACK_ROW_LENGTH, 0},  {GL_UNPACK_IMAGE_HEIGHT, 0}, {GL_UNPACK_SKIP_PIXELS, 0}, {GL_UNPACK_SKIP_ROWS, 0},
    {GL_UNPACK_SKIP_IMAGES, 0}, {GL_UNPACK_ALIGNMENT, 4}};

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

}  // namespace

StateKeeper::StateKeeper() {
  save_bindings();
  save_pipeline();
  set_defaults();
}

StateKeeper::~StateKeeper() {
  restore_pipeline();
  restore_bindings();
}

StateKeeper::IndexedBuffer StateKeeper::indexed_buffer(GLenum binding, GLenum start, GLenum size, GLuint index) {
  IndexedBuffer buffer{get(binding, index), 0, 0};
  glGetInteger64i_v(start, index, &buffer.start);
  glGetInteger64i_v(size, index, &buffer.size);
  return buffer;
}

void StateKeeper::restore(GLenum target, GLuint index, const IndexedBuffer& buffer) {
  // A size of 0 says that the whole buffer was bound.
  if (buffer.name != 0 && buffer.size != 0) {
    glBindBufferRange(target, index, name_of(buffer.name), buffer.start, buffer.size);
  } else {
    glBindBufferBase(target, index, name_of(buffer.name));
  }
}

void StateKeeper::save_bindings() {
  program_ = get(GL_CURRENT_PROGRAM);
  vertex_array_ = get(GL_VERTEX_ARRAY_BINDING);
  draw_framebuffer_ = get(GL_DRAW_FRAMEBUFFER_BINDING);
  read_framebuffer_ = get(GL_READ_FRAMEBUFFER_BINDING);
  active_unit_ = get(GL_ACTIVE_TEXTURE);
  for (std::size_t unit = 0; unit < textures_.size(); ++unit) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    textures_[unit] = get(target_of(unit).binding);
    samplers_[unit] = get(GL_SAMPLER_BINDING);
  }
  uniform_buffer_ = get(GL_UNIFORM_BUFFER_BINDING);
  storage_buffer_ = get(GL_SHADER_STORAGE_BUFFER_BINDING);
  counter_buffer_ = get(GL_ATOMIC_COUNTER_BUFFER_BINDING);
  indirect_buffer_ = get(GL_DRAW_INDIRECT_BUFFER_BINDING);
  pack_buffer_ = get(GL_PIXEL_PACK_BUFFER_BINDING);
  unpack_buffer_ = get(GL_PIXEL_UNPACK_BUFFER_BINDING);
  uniforms_ = indexed_buffer(GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE, 0);
  counters_ = indexed_buffer(GL_ATOMIC_COUNTER_BUFFER_BINDING, GL_ATOMIC_COUNTER_BUFFER_START,
                             GL_ATOMIC_COUNTER_BUFFER_SIZE, 0);
  for (GLuint i = 0; i < storage_.size(); ++i) {
    storage_[i] = indexed_buffer(GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START,
                                 GL_SHADER_STORAGE_BUFFER_SIZE, i);
  }
  for (GLuint i = 0; i < images_.size(); ++i) {
    images_[i] = {get(GL_IMAGE_BINDING_NAME, i),  get(GL_IMAGE_BINDING_LEVEL, i),  get(GL_IMAGE_BINDING_LAYERED, i),
                  get(GL_IMAGE_BINDING_LAYER, i), get(GL_IMAGE_BINDING_ACCESS, i), get(GL_IMAGE_BINDING_FORMAT, i)};
  }
  for (const PixelStore& parameter : kPixelStore) pixel_store_.push_back(get(parameter.name));
}

void StateKeeper::save_pipeline() {
  for (GLenum capability : kCapabilities) capabilities_.push_back(glIsEnabled(capability));
  has_scissor_ = glIsEnabledi(GL_SCISSOR_TEST, 0);
  glGetFloati_v(GL_VIEWPORT, 0, viewport_.data());
  glGetDoublei_v(GL_DEPTH_RANGE, 0, depth_range_.data());
  for (GLuint i = 0; i < color_masks_.size(); ++i) glGetBooleani_v(GL_COLOR_WRITEMASK, i, color_masks_[i].data());
  glGetBooleanv(GL_DEPTH_WRITEMASK, &depth_mask_);
  depth_function_ = get(GL_DEPTH_FUNC);
  cull_mode_ = get(GL_CULL_FACE_MODE);
  front_face_ = get(GL_FRONT_FACE);
  logic_operation_ = get(GL_LOGIC_OP_MODE);
  clip_origin_ = get(GL_CLIP_ORIGIN);
  clip_depth_ = get(GL_CLIP_DEPTH_MODE);
  glGetIntegerv(GL_POLYGON_MODE, polygon_mode_.data());
}

void StateKeeper::set_defaults() {
  for (GLenum capability : kCapabilities) glDisable(capability);
  glDisablei(GL_SCISSOR_TEST, 0);
  glDepthRangeIndexed(0, 0.0, 1.0);
  for (GLuint i = 0; i < color_masks_.size(); ++i) glColorMaski(i, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_FALSE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  for (const PixelStore& parameter : kPixelStore) glPixelStorei(parameter.name, parameter.tight);
  for (GLuint unit = 0; unit < LKAO_UNIT_COUNT; ++unit) glBindSampler(unit, 0);
}

void StateKeeper::restore_pipeline() const {
  for (std::size_t i = 0; i < capabilities_.size(); ++i) enable(kCapabilities[i], capabilities_[i] == GL_TRUE);
  if (has_scissor_ == GL_TRUE) glEnablei(GL_SCISSOR_TEST, 0);
  glViewportIndexedf(0, viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
  glDepthRangeIndexed(0, depth_range_[0], depth_range_[1]);
  for (GLuint i = 0; i < color_masks_.size(); ++i) {
    const auto& mask = color_masks_[i];
    glColorMaski(i, mask[0], mask[1], mask[2], mask[3]);
  }
  glDepthMask(depth_mask_);
  glDepthFunc(enum_of(depth_function_));
  glCullFace(enum_of(cull_mode_));
  glFrontFace(enum_of(front_face_));
  glLogicOp(enum_of(logic_operation_));
  glClipControl(enum_of(clip_origin_), enum_of(clip_depth_));
  glPolygonMode(GL_FRONT_AND_BACK, enum_of(polygon_mode_[0]));
}

void StateKeeper::restore_bindings() const {
  glUseProgram(name_of(program_));
  glBindVertexArray(name_of(vertex_array_));
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, name_of(draw_framebuffer_));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, name_of(read_framebuffer_));
  for (std::size_t unit = 0; unit < textures_.size(); ++unit) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(target_of(unit).target, name_of(textures_[unit]));
    glBindSampler(static_cast<GLuint>(unit), name_of(samplers_[unit]));
  }
  glActiveTexture(enum_of(active_unit_));
  restore(GL_UNIFORM_BUFFER, 0, uniforms_);
  restore(GL_ATOMIC_COUNTER_BUFFER, 0, counters_);
  for (GLuint i = 0; i < storage_.size(); ++i) restore(GL_SHADER_STORAGE_BUFFER, i, storage_[i]);
  // After the indexed ones, which change these as well.
  glBindBuffer(GL_UNIFORM_BUFFER, name_of(uniform_buffer_));
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, name_of(storage_buffer_));
  glBindBuffer(GL_ATOMIC_COUNTER_BUFFER, name_of(counter_buffer_));
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, name_of(indirect_buffer_));
  glBindBuffer(GL_PIXEL_PACK_BUFFER, name_of(pack_buffer_));
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, name_of(unpack_buffer_));
  for (GLuint i = 0; i < images_.size(); ++i) {
    const ImageUnit& image = images_[i];
    glBindImageTexture(i, name_of(image.name), image.level, static_cast<GLboolean>(image.is_layered), image.layer,
                       enum_of(image.access), enum_of(image.format));
  }
  for (std::size_t i = 0; i < pixel_store_.size(); ++i) glPixelStorei(kPixelStore[i].name, pixel_store_[i]);
}

}  // namespace lkao::gl
