// Is a G-buffer what its caller says? Asked of the first frame of each kind, for mistakes that nothing else would name.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gpu/gl/objects.h"
#include "gpu/gl/program.h"
#include "lkao/gl/frame.h"
#include "lkao/receiver.h"

namespace lkao::gl {

class GBufferCheck {
 public:
  // Looks at 256 pixels where this kind of G-buffer (which textures, their formats and spaces) was not the last looked
  // at, or showed no receiver then: a small compute shader, and the time that the GPU takes to come to it. Needs
  // validate(), the view block and the textures bound, and shader storage 0. Throws std::invalid_argument where most
  // positions are not at their pixels.
  void look_at(const GBuffer& g_buffer);

  // Remarks about the kind that was last looked at.
  std::vector<std::string> remarks(const RayOptions& options) const;

 private:
  struct Kind {
    unsigned place_format = 0, normal_format = 0, geometric_normal_format = 0;
    bool has_positions = false, has_depth = false;
    PositionSpace position_space = PositionSpace::world;
    NormalSpace normal_space = NormalSpace::world;
    NormalEncoding normal_encoding = NormalEncoding::xyz;
    bool operator==(const Kind&) const = default;
  };
  static Kind kind_of(const GBuffer& g_buffer);

  std::optional<Kind> checked_;
  bool has_half_positions_ = false;
  float largest_error_ = 0, largest_texel_ = 0;
  ProgramObject program_;
  Buffer results_;
};

}  // namespace lkao::gl
