#include "gpu/screen/picture.h"

#include <epoxy/gl.h>

#include <iterator>

#include "gpu/frame/g_buffer.h"
#include "gpu/frame/grown_size.h"
#include "gpu/frame/occlusion_target.h"
#include "gpu/frame/view.h"
#include "gpu/gl/error.h"
#include "gpu/gl/program.h"
#include "gpu/screen/units.h"

namespace lkao::gl {
namespace {

constexpr GLenum kPictureTargets[] = {GL_TEXTURE_2D, GL_TEXTURE_2D, GL_TEXTURE_2D, GL_TEXTURE_2D, GL_TEXTURE_2D_ARRAY};
static_assert(std::size(kPictureTargets) == LKAO_SCREEN_UNIT_COUNT);

}  // namespace

const StateUse kPictureUse{
    .texture_targets = kPictureTargets, .image_count = LKAO_FRAME_IMAGE_COUNT, .block_count = LKAO_BLOCK_COUNT};

Picture::Picture() : plain_sampler_(make_plain_sampler()), find_receivers_(make_program({"screen/receivers.comp"})) {}

void Picture::make_room(int width, int height) {
  width_ = width;
  height_ = height;
  if (width <= texture_width_ && height <= texture_height_) return;
  const Size size = grown_size({width, height}, {texture_width_, texture_height_});
  receivers_ = make_texture(GL_TEXTURE_2D_ARRAY);
  texture_width_ = texture_height_ = 0;
  glTextureStorage3D(receivers_.name(), 1, GL_RGBA32F, size.width, size.height, LKAO_SCREEN_LAYER_COUNT);
  check_errors("making room for the receivers of a picture");
  texture_width_ = size.width;
  texture_height_ = size.height;
}

void Picture::find_receivers(const GBuffer& g_buffer, const ViewBlock& view) {
  make_room(view.width, view.height);
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);  // what read the last frame's receivers comes first
  view_buffer_.set_and_bind(view);
  bind(g_buffer, plain_sampler_);
  glUseProgram(find_receivers_.name());
  glBindImageTexture(0, receivers_.name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA32F);
  dispatch_over_pixels(width_, height_);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  glBindTextureUnit(LKAO_UNIT_SCREEN_RECEIVERS, receivers_.name());
  glBindSampler(LKAO_UNIT_SCREEN_RECEIVERS, plain_sampler_.name());
}

void Picture::write(const ProgramObject& program, const OcclusionTarget& to) const {
  glUseProgram(program.name());
  bind(to, target_buffer_, plain_sampler_);
  begin_writing_targets();
  dispatch_over_pixels(width_, height_);
  end_writing_targets();
}

}  // namespace lkao::gl
