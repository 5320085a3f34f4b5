// Are the caller's textures what they should be? Each throws std::invalid_argument that names the texture and its
// fault.
#pragma once

#include <epoxy/gl.h>

#include <initializer_list>
#include <optional>

#include "lkao/gl/frame.h"

namespace lkao::gl {

// Pixels that a texture must have: just these, or at least these from `part` on.
struct Room {
  int width, height;
  std::optional<Part> part = {};
};

// A GL_TEXTURE_2D with that room.
void require_size(const char* name, ObjectName texture, const Room& room);

// What shaders read from a texture, as floats.
enum class Use { value, depth, distance, position, normal };

// One with that room and at least so many components, in a format that can hold what is read.
void require_readable(const char* name, ObjectName texture, const Room& room, int component_count, Use use);

// One of these internal formats; `known` is how the message says them.
void require_format(const char* name, ObjectName texture, const char* known, std::initializer_list<GLenum> formats);

// The internal format of level 0.
GLenum format_of(ObjectName texture);

// From one value that the red (or depth) component can have to the next: always, and as a share of the power of two
// below it.
struct Steps {
  float fixed = 0, relative = 0;
};
Steps steps_of(ObjectName texture);

// Component 0 is red, 3 alpha.
bool has_component(ObjectName texture, int i);

// Of normalised numbers: steps from 0 to 1; 0 where there is no such component.
float step_count(ObjectName texture, int component);

// Unsigned and normalised, so that shaders see 0 to 1.
bool is_unorm(ObjectName texture);

}  // namespace lkao::gl
