// The kinds of G-buffer that deferred renderers have, as this one makes them and as it tells lkao.
#pragma once

#include <span>
#include <string>

#include <lkao/gl.h>

namespace deferred {

// What the first texture holds.
enum class Place { depth, linear_depth, positions };

struct Kind {
  const char* name;
  Place place;
  unsigned place_format;
  unsigned normal_format = 0x881A;  // GL_RGBA16F, as the tutorial has it
  lkao::gl::PositionSpace position_space = lkao::gl::PositionSpace::world;
  lkao::gl::NormalSpace normal_space = lkao::gl::NormalSpace::view;
  lkao::gl::NormalEncoding normal_encoding = lkao::gl::NormalEncoding::xyz;
  bool is_reversed = false;  // depth: 1 at the near plane, 0 at infinity
  bool is_part = false;      // drawn to a part of larger textures, as for dynamic resolution
  int step = 1;              // 2: occlusion at half resolution
};

// The first one is the tutorial's.
std::span<const Kind> all_kinds();

}  // namespace deferred
