// A picture whose receivers are read many times: what passes have that gather from the pixels around one.
#pragma once

#include "gpu/frame/target_block.h"
#include "gpu/frame/view_block.h"
#include "gpu/gl/objects.h"
#include "gpu/gl/state_keeper.h"
#include "gpu/gl/uniform_buffer.h"
#include "lkao/gl/frame.h"

namespace lkao::gl {

// Of a pass that binds nothing of its own but its block.
extern const StateUse kPictureUse;

// Of the context that is current when it is made. Textures are larger than the picture where earlier ones were.
class Picture {
 public:
  Picture();

  // Binds the view, finds the receivers of the G-buffer, and binds them for gpu/screen/receivers.glsl.
  void find_receivers(const GBuffer& g_buffer, const ViewBlock& view);
  // Runs a compute program, whose groups are of 8 x 8 pixels, over all of them; it writes to `to` by
  // gpu/frame/target.glsl. All else that it needs is bound.
  void write(const ProgramObject& program, const OcclusionTarget& to) const;

  int width() const { return width_; }
  int height() const { return height_; }
  // Reads textures as they are.
  const Sampler& plain_sampler() const { return plain_sampler_; }

 private:
  void make_room(int width, int height);

  int width_ = 0, height_ = 0;
  int texture_width_ = 0, texture_height_ = 0;
  Texture receivers_;  // LKAO_SCREEN_*
  UniformBuffer<ViewBlock> view_buffer_;
  UniformBuffer<TargetBlock> target_buffer_;
  Sampler plain_sampler_;
  ProgramObject find_receivers_;
};

}  // namespace lkao::gl
