#include "gpu/frame/texture_checks.h"

#include <cmath>
#include <cstdint>
#include <stdexcept>

#include <fmt/format.h>

#include "gpu/frame/format_names.h"

namespace lkao::gl {
namespace {

GLint level_parameter(ObjectName texture, GLenum name) {
  GLint value = 0;
  glGetTextureLevelParameteriv(texture, 0, name, &value);
  return value;
}

bool is_integer(GLint type) { return type == GL_INT || type == GL_UNSIGNED_INT; }

// Null where the format can hold what is read.
const char* why_useless(ObjectName texture, Use use) {
  const GLenum format = format_of(texture);
  const bool is_srgb = format == GL_SRGB8 || format == GL_SRGB8_ALPHA8 || format == GL_SRGB || format == GL_SRGB_ALPHA;
  const bool has_no_sign = format == GL_R11F_G11F_B10F || format == GL_RGB9_E5;
  const bool is_depth = level_parameter(texture, GL_TEXTURE_DEPTH_TYPE) != GL_NONE;
  switch (use) {
    case Use::normal:
      if (is_srgb) return "shaders read its numbers decoded as colours";
      if (has_no_sign) return "its floats have no sign";
      return nullptr;
    case Use::position:
      if (is_srgb || is_unorm(texture)) return "it holds 0 to 1 only";
      if (has_no_sign) return "its floats have no sign";
      return nullptr;
    case Use::distance:
      if (is_depth || is_srgb || is_unorm(texture)) {
        return "it holds 0 to 1 only, and linear_depth is a distance in the unit of positions";
      }
      return nullptr;
    case Use::depth:
      return is_srgb ? "shaders read its numbers decoded as colours" : nullptr;
    default:
      return nullptr;
  }
}

void require_room(const char* name, const Room& room, int width, int height) {
  if (!room.part) {
    if (width == room.width && height == room.height) return;
    throw std::invalid_argument(
        fmt::format("{} must be of {}x{} pixels, not {}x{}", name, room.width, room.height, width, height));
  }
  const Part& part = *room.part;
  // In 64 bits: a part may begin anywhere.
  const bool fits = part.x >= 0 && part.y >= 0 && std::int64_t{part.x} + room.width <= width &&
                    std::int64_t{part.y} + room.height <= height;
  if (fits) return;
  throw std::invalid_argument(fmt::format("{} of {}x{} pixels has no part of {}x{} at ({}, {})", name, width, height,
                                          room.width, room.height, part.x, part.y));
}

}  // namespace

void require_size(const char* name, ObjectName texture, const Room& room) {
  if (texture == 0) throw std::invalid_argument(fmt::format("{} is not set", name));
  if (glIsTexture(texture) != GL_TRUE) {
    throw std::invalid_argument(
        fmt::format("{} is {}, which is no texture of the current context: was it made in one that shares nothing with "
                    "this, deleted, or never bound?",
                    name, texture));
  }
  GLint target = 0;
  glGetTextureParameteriv(texture, GL_TEXTURE_TARGET, &target);
  if (target != GL_TEXTURE_2D) {
    throw std::invalid_argument(fmt::format("{} must be a GL_TEXTURE_2D, not a texture of target {:#x}", name, target));
  }
  const GLint has_width = level_parameter(texture, GL_TEXTURE_WIDTH);
  const GLint has_height = level_parameter(texture, GL_TEXTURE_HEIGHT);
  require_room(name, room, has_width, has_height);
}

void require_readable(const char* name, ObjectName texture, const Room& room, int component_count, Use use) {
  require_size(name, texture, room);
  const GLint red = level_parameter(texture, GL_TEXTURE_RED_TYPE);
  const bool is_depth = level_parameter(texture, GL_TEXTURE_DEPTH_TYPE) != GL_NONE;
  const bool has_all = component_count == 1 || has_component(texture, component_count - 1);
  if (is_integer(red) || (red == GL_NONE && !is_depth) || !has_all) {
    throw std::invalid_argument(fmt::format("{} must have {} float or normalised components, not the format {}", name,
                                            component_count, format_name(format_of(texture))));
  }
  if (const char* reason = why_useless(texture, use)) {
    throw std::invalid_argument(fmt::format("{} cannot be in {}: {}", name, format_name(format_of(texture)), reason));
  }
}

void require_format(const char* name, ObjectName texture, const char* known, std::initializer_list<GLenum> formats) {
  const GLenum format = format_of(texture);
  for (GLenum possible : formats) {
    if (format == possible) return;
  }
  throw std::invalid_argument(
      fmt::format("{} must have one of the formats {}, not {}", name, known, format_name(format)));
}

GLenum format_of(ObjectName texture) {
  return static_cast<GLenum>(level_parameter(texture, GL_TEXTURE_INTERNAL_FORMAT));
}

Steps steps_of(ObjectName texture) {
  const bool is_depth = level_parameter(texture, GL_TEXTURE_DEPTH_TYPE) != GL_NONE;
  const GLint type = level_parameter(texture, is_depth ? GL_TEXTURE_DEPTH_TYPE : GL_TEXTURE_RED_TYPE);
  const GLint bits = level_parameter(texture, is_depth ? GL_TEXTURE_DEPTH_SIZE : GL_TEXTURE_RED_SIZE);
  if (type == GL_UNSIGNED_NORMALIZED) return {1 / (std::ldexp(1.0f, bits) - 1), 0};
  if (type == GL_SIGNED_NORMALIZED) return {1 / (std::ldexp(1.0f, bits - 1) - 1), 0};
  // Floats; of fewer bits the smallest are all as far from each other.
  if (bits >= 32) return {0, 0x1p-23f};
  return {0x1p-24f, 0x1p-10f};
}

bool has_component(ObjectName texture, int i) {
  constexpr GLenum kTypes[] = {GL_TEXTURE_RED_TYPE, GL_TEXTURE_GREEN_TYPE, GL_TEXTURE_BLUE_TYPE, GL_TEXTURE_ALPHA_TYPE};
  return level_parameter(texture, kTypes[i]) != GL_NONE;
}

float step_count(ObjectName texture, int component) {
  constexpr GLenum kSizes[] = {GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE, GL_TEXTURE_ALPHA_SIZE};
  return std::ldexp(1.0f, level_parameter(texture, kSizes[component])) - 1;
}

bool is_unorm(ObjectName texture) { return level_parameter(texture, GL_TEXTURE_RED_TYPE) == GL_UNSIGNED_NORMALIZED; }

}  // namespace lkao::gl
