#include "gpu/frame/g_buffer.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "gpu/frame/limits.h"
#include "gpu/frame/texture_checks.h"
#include "gpu/frame/units.h"
#include "gpu/frame/view.h"
#include "lut/coordinates.h"
#include "lut/ray_options.h"

namespace lkao::gl {

static_assert(static_cast<float>(LKAO_LARGEST_COORDINATE) == lut::kLargestCoordinate);

void validate(const GBuffer& g_buffer) {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  const int width = g_buffer.width, height = g_buffer.height;
  const Room room{width, height, g_buffer.part};
  if (width < 1 || height < 1 || width > largest || height > largest) {
    throw std::invalid_argument(
        fmt::format("the G-buffer's size must be from 1x1 to {0}x{0}, not {1}x{2}", largest, width, height));
  }
  lut::require(g_buffer.step >= 1 && g_buffer.step <= 16, "step", "from 1 to 16", g_buffer.step);
  const int place_count = (g_buffer.depth != 0) + (g_buffer.linear_depth != 0) + (g_buffer.positions != 0);
  if (place_count != 1) {
    throw std::invalid_argument(
        fmt::format("exactly one of depth, linear_depth and positions must be given, not {}", place_count));
  }
  const auto require = [&](const char* name, ObjectName texture, int component_count, Use use) {
    require_readable(name, texture, room, component_count, use);
  };
  if (g_buffer.depth != 0) require("depth", g_buffer.depth, 1, Use::depth);
  if (g_buffer.linear_depth != 0) require("linear_depth", g_buffer.linear_depth, 1, Use::distance);
  if (g_buffer.positions != 0) require("positions", g_buffer.positions, 3, Use::position);
  const int normal_size = g_buffer.normal_encoding == NormalEncoding::xyz ? 3 : 2;
  require("normals", g_buffer.normals, normal_size, Use::normal);
  if (g_buffer.geometric_normals != 0) {
    require("geometric_normals", g_buffer.geometric_normals, normal_size, Use::normal);
  }
  if (g_buffer.colours != 0) require("colours", g_buffer.colours, 3, Use::value);
  if (g_buffer.normal_encoding == NormalEncoding::xy && g_buffer.normal_space != NormalSpace::view) {
    throw std::invalid_argument("normal_encoding xy needs normals in view space: set normal_space");
  }
}

namespace {

ObjectName geometric_normals_of(const GBuffer& g_buffer) {
  return g_buffer.geometric_normals != 0 ? g_buffer.geometric_normals : g_buffer.normals;
}

void describe_errors(const GBuffer& g_buffer, ViewBlock& view) {
  const Steps steps = steps_of(place_of(g_buffer)), normal_steps = steps_of(geometric_normals_of(g_buffer));
  view.place_step = steps.fixed;
  view.place_ulp = steps.relative;
  // Of each component, as wide as they are decoded.
  const bool is_unsigned = is_unorm(geometric_normals_of(g_buffer));
  const float step = (is_unsigned ? 2.0f : 1.0f) * normal_steps.fixed + normal_steps.relative;
  switch (g_buffer.normal_encoding) {
    case NormalEncoding::xyz:
      view.normal_error = std::numbers::sqrt3_v<float> * step;
      break;
    case NormalEncoding::octahedral:
      // The third changes by as much as both others, and the octahedron is as near as 1 / sqrt 3.
      view.normal_error = std::sqrt(6.0f) * std::numbers::sqrt3_v<float> * step;
      break;
    case NormalEncoding::xy:
      view.normal_error = std::sqrt(3.0f * step);  // where z is near 0
      break;
  }
}

}  // namespace

ViewBlock make_view_block(const GBuffer& g_buffer, const Camera& camera) {
  ViewBlock view = make_view_block(camera, pixels_of(g_buffer));
  const Part first = g_buffer.part.value_or(Part{});
  view.first_x = first.x;
  view.first_y = first.y;
  view.step = g_buffer.step;
  view.place = g_buffer.depth != 0          ? LKAO_PLACE_DEPTH
               : g_buffer.linear_depth != 0 ? LKAO_PLACE_LINEAR_DEPTH
                                            : LKAO_PLACE_POSITION;
  view.has_view_space_positions = g_buffer.position_space == PositionSpace::view;
  view.normal_encoding = g_buffer.normal_encoding == NormalEncoding::octahedral ? LKAO_NORMALS_OCTAHEDRAL
                         : g_buffer.normal_encoding == NormalEncoding::xy       ? LKAO_NORMALS_XY
                                                                                : LKAO_NORMALS_XYZ;
  view.has_unorm_normals = is_unorm(g_buffer.normals);
  view.has_view_space_normals = g_buffer.normal_space == NormalSpace::view;
  if (g_buffer.geometric_normals != 0) {
    view.has_geometric_normals = 1;
    view.has_unorm_geometric_normals = is_unorm(g_buffer.geometric_normals);
  }
  describe_errors(g_buffer, view);
  return view;
}

void bind(const GBuffer& g_buffer, const Sampler& plain_sampler) {
  glBindTextureUnit(LKAO_UNIT_PLACE, place_of(g_buffer));
  glBindTextureUnit(LKAO_UNIT_NORMALS, g_buffer.normals);
  // Not without one: that would unbind textures of all targets.
  if (g_buffer.geometric_normals != 0) glBindTextureUnit(LKAO_UNIT_GEOMETRIC_NORMALS, g_buffer.geometric_normals);
  for (int unit : {LKAO_UNIT_PLACE, LKAO_UNIT_NORMALS, LKAO_UNIT_GEOMETRIC_NORMALS}) {
    glBindSampler(static_cast<GLuint>(unit), plain_sampler.name());
  }
}

}  // namespace lkao::gl
