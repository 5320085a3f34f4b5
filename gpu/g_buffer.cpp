#include "gpu/g_buffer.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <initializer_list>
#include <stdexcept>

#include "gpu/shaders/constants.h"

namespace lkao::gl {
namespace {

GLint level_parameter(ObjectName texture, GLenum name) {
  GLint value = 0;
  glGetTextureLevelParameteriv(texture, 0, name, &value);
  return value;
}

void require_size(const char* name, ObjectName texture, int width, int height) {
  if (glIsTexture(texture) != GL_TRUE) {
    throw std::invalid_argument(fmt::format("{} is {}, which is no texture of the current context", name, texture));
  }
  GLint target = 0;
  glGetTextureParameteriv(texture, GL_TEXTURE_TARGET, &target);
  if (target != GL_TEXTURE_2D) {
    throw std::invalid_argument(fmt::format("{} must be a GL_TEXTURE_2D, not a texture of target {:#x}", name, target));
  }
  const GLint has_width = level_parameter(texture, GL_TEXTURE_WIDTH);
  const GLint has_height = level_parameter(texture, GL_TEXTURE_HEIGHT);
  if (has_width != width || has_height != height) {
    throw std::invalid_argument(
        fmt::format("{} must be of {}x{} pixels, not {}x{}", name, width, height, has_width, has_height));
  }
}

bool is_integer(GLint type) { return type == GL_INT || type == GL_UNSIGNED_INT; }

// A texture that shaders read as floats, with at least so many components.
void require_readable(const char* name, ObjectName texture, const GBuffer& g_buffer, int component_count) {
  require_size(name, texture, g_buffer.width, g_buffer.height);
  const GLint red = level_parameter(texture, GL_TEXTURE_RED_TYPE);
  const bool is_depth = level_parameter(texture, GL_TEXTURE_DEPTH_TYPE) != GL_NONE;
  const bool has_all = level_parameter(texture, GL_TEXTURE_BLUE_TYPE) != GL_NONE || component_count == 1;
  if (is_integer(red) || (red == GL_NONE && !is_depth) || !has_all) {
    throw std::invalid_argument(fmt::format("{} must have {} float or normalised components, not the format {:#x}",
                                            name, component_count, format_of(texture)));
  }
}

bool is_unorm(ObjectName texture) { return level_parameter(texture, GL_TEXTURE_RED_TYPE) == GL_UNSIGNED_NORMALIZED; }

void require_format(const char* name, ObjectName texture, const char* known, std::initializer_list<GLenum> formats) {
  const GLenum format = format_of(texture);
  for (GLenum possible : formats) {
    if (format == possible) return;
  }
  throw std::invalid_argument(fmt::format("{} must have one of the formats {}, not {:#x}", name, known, format));
}

}  // namespace

unsigned format_of(ObjectName texture) {
  return static_cast<GLenum>(level_parameter(texture, GL_TEXTURE_INTERNAL_FORMAT));
}

void validate(const GBuffer& g_buffer) {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (g_buffer.width < 1 || g_buffer.height < 1 || g_buffer.width > largest || g_buffer.height > largest) {
    throw std::invalid_argument(fmt::format("the G-buffer's size must be from 1x1 to {0}x{0}, not {1}x{2}", largest,
                                            g_buffer.width, g_buffer.height));
  }
  const int place_count = (g_buffer.depth != 0) + (g_buffer.linear_depth != 0) + (g_buffer.positions != 0);
  if (place_count != 1) {
    throw std::invalid_argument(
        fmt::format("exactly one of depth, linear_depth and positions must be given, not {}", place_count));
  }
  if (g_buffer.depth != 0) require_readable("depth", g_buffer.depth, g_buffer, 1);
  if (g_buffer.linear_depth != 0) require_readable("linear_depth", g_buffer.linear_depth, g_buffer, 1);
  if (g_buffer.positions != 0) require_readable("positions", g_buffer.positions, g_buffer, 3);
  require_readable("normals", g_buffer.normals, g_buffer, 3);
  if (g_buffer.geometric_normals != 0) require_readable("geometric_normals", g_buffer.geometric_normals, g_buffer, 3);
}

void validate(const ResolveTargets& targets, int width, int height) {
  if (targets.occlusion != 0) {
    require_size("occlusion", targets.occlusion, width, height);
    require_format("occlusion", targets.occlusion, "GL_R8, GL_R16, GL_R16F and GL_R32F",
                   {GL_R8, GL_R16, GL_R16F, GL_R32F});
  }
  if (targets.bent_normals != 0) {
    require_size("bent_normals", targets.bent_normals, width, height);
    require_format("bent_normals", targets.bent_normals, "GL_RGBA16F and GL_RGBA32F", {GL_RGBA16F, GL_RGBA32F});
  }
}

void bind(const GBuffer& g_buffer, const Camera& camera, PassUniforms& uniforms) {
  uniforms.extent.x = g_buffer.width;
  uniforms.extent.y = g_buffer.height;
  uniforms.extent.w = g_buffer.depth != 0          ? LKAO_PLACE_DEPTH
                      : g_buffer.linear_depth != 0 ? LKAO_PLACE_LINEAR_DEPTH
                                                   : LKAO_PLACE_POSITION;
  glBindTextureUnit(LKAO_UNIT_PLACE, g_buffer.depth + g_buffer.linear_depth + g_buffer.positions);
  glBindTextureUnit(LKAO_UNIT_NORMALS, g_buffer.normals);
  if (is_unorm(g_buffer.normals)) uniforms.flags.x |= LKAO_FLAG_UNORM_NORMALS;
  if (g_buffer.geometric_normals != 0) {
    glBindTextureUnit(LKAO_UNIT_GEOMETRIC_NORMALS, g_buffer.geometric_normals);
    uniforms.flags.x |= LKAO_FLAG_GEOMETRIC_NORMALS;
    if (is_unorm(g_buffer.geometric_normals)) uniforms.flags.x |= LKAO_FLAG_UNORM_GEOMETRIC_NORMALS;
  }
  if (g_buffer.normal_space == NormalSpace::view) {
    uniforms.flags.x |= LKAO_FLAG_VIEW_SPACE_NORMALS;
    // The inverse of a rotation: its rows.
    for (int i = 0; i < 3; ++i) {
      uniforms.normal_to_world[i] = glm::vec4(camera.view[0][i], camera.view[1][i], camera.view[2][i], 0);
    }
  }
}

}  // namespace lkao::gl
