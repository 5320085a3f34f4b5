// The uniform block of gpu/shaders/pass.glsl, byte by byte (std140).
#pragma once

#include <cstddef>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace lkao::gl {

struct PassUniforms {
  glm::dmat4 world_from_clip{1};
  glm::mat4 clip_from_world{1};
  glm::vec4 view_depth{0};
  glm::vec4 eye{0};
  glm::vec4 normal_to_world[3]{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  glm::vec4 depth_map{0};
  glm::vec4 lengths{0};
  glm::vec4 jitter{0};
  glm::ivec4 extent{0};
  glm::uvec4 flags{0};
  glm::uvec4 cells{0};
  glm::uvec4 cell_offsets{0};
};
static_assert(offsetof(PassUniforms, clip_from_world) == 128 && sizeof(PassUniforms) == 384);

}  // namespace lkao::gl
