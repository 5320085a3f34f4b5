#include "gpu/view.h"

#include <cmath>
#include <stdexcept>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "gpu/shaders/constants.h"

namespace lkao::gl {
namespace {

glm::dvec4 row(const glm::dmat4& matrix, int i) { return {matrix[0][i], matrix[1][i], matrix[2][i], matrix[3][i]}; }

bool is_finite(const glm::mat4& matrix) {
  for (int column = 0; column < 4; ++column) {
    for (int i = 0; i < 4; ++i) {
      if (!std::isfinite(matrix[column][i])) return false;
    }
  }
  return true;
}

void require_rigid(const glm::mat4& view) {
  const glm::dmat3 turn(view);
  const glm::dmat3 product = glm::transpose(turn) * turn;
  double error = 0;
  for (int column = 0; column < 3; ++column) {
    for (int i = 0; i < 3; ++i) error = std::fmax(error, std::fabs(product[column][i] - (column == i ? 1 : 0)));
  }
  if (!is_finite(view) || error > 1e-3 || row(view, 3) != glm::dvec4(0, 0, 0, 1)) {
    throw std::invalid_argument("camera.view must be a rigid motion (a rotation and a translation)");
  }
}

bool is_perspective(const glm::mat4& projection) {
  const glm::dvec4 w = row(projection, 3);
  const bool has_perspective = w == glm::dvec4(0, 0, -1, 0), has_none = w == glm::dvec4(0, 0, 0, 1);
  const double det = glm::determinant(glm::dmat4(projection));
  if (!is_finite(projection) || (!has_perspective && !has_none) || det == 0) {
    throw std::invalid_argument(
        "camera.projection must be a perspective or an orthographic projection of a camera that looks along -z");
  }
  return has_perspective;
}

// Normalised device depth = z[0] + z[1] along for orthographic, z[0] + z[1] / along for perspective cameras.
struct DepthMap {
  double offset, slope;
};

DepthMap depth_map_of(const glm::mat4& projection, bool has_perspective) {
  const double a = projection[2][2], b = projection[3][2];
  return has_perspective ? DepthMap{-a, b} : DepthMap{b, -a};
}

}  // namespace

void set_view(const Camera& camera, int width, int height, float radius, PassUniforms& uniforms) {
  require_rigid(camera.view);
  const bool has_perspective = is_perspective(camera.projection);
  const bool zero_to_one = camera.clip_depth == ClipDepth::zero_to_one;
  const DepthMap depth = depth_map_of(camera.projection, has_perspective);
  const bool is_reversed = has_perspective ? depth.slope > 0 : depth.slope < 0;
  uniforms.flags.x |= (has_perspective ? LKAO_FLAG_PERSPECTIVE : 0u) | (zero_to_one ? LKAO_FLAG_ZERO_TO_ONE : 0u) |
                      (is_reversed ? LKAO_FLAG_REVERSED : 0u);

  const glm::dmat4 view(camera.view), clip_from_world = glm::dmat4(camera.projection) * view;
  const glm::dmat4 world_from_view = glm::inverse(view);
  uniforms.world_from_clip = glm::inverse(clip_from_world);
  const glm::dvec4 view_depth = -row(view, 2);
  uniforms.view_depth = glm::vec4(view_depth);
  uniforms.eye = has_perspective ? glm::vec4(world_from_view[3]) : glm::vec4(-world_from_view[2]);

  // Shapes go through the same projection but for depth (gpu/shaders/depth.glsl), whose row is the pass's own.
  glm::dvec4 depth_row;
  if (has_perspective) {
    // 1 / 1024 of the radius: nothing nearer matters, and float keeps its precision whatever the scale.
    uniforms.depth_map = glm::vec4(radius * 0x1p-10f, 0, 0, 0);
    depth_row = glm::dvec4(0, 0, 0, uniforms.depth_map.x);
  } else {
    const double first = ((zero_to_one ? 0.0 : -1.0) - depth.offset) / depth.slope;
    const double second = (1.0 - depth.offset) / depth.slope;
    uniforms.depth_map = glm::vec4(std::fmax(first, second), 1.0 / std::fabs(second - first), 0, 0);
    depth_row = -static_cast<double>(uniforms.depth_map.y) * view_depth;
    depth_row.w += static_cast<double>(uniforms.depth_map.y) * static_cast<double>(uniforms.depth_map.x);
  }
  glm::dmat4 volumes = clip_from_world;
  for (int column = 0; column < 4; ++column) volumes[column][2] = depth_row[column];
  uniforms.clip_from_world = glm::mat4(volumes);

  // World units a pixel is wide (at distance 1 from a perspective camera), the larger of both axes.
  const double x = 2.0 / (width * glm::length(glm::dvec3(row(camera.projection, 0)) * glm::dvec3(1, 1, 0)));
  const double y = 2.0 / (height * glm::length(glm::dvec3(row(camera.projection, 1)) * glm::dvec3(1, 1, 0)));
  uniforms.lengths.w = static_cast<float>(std::fmax(x, y));
}

bool is_mirrored(const Camera& camera) {
  const glm::dmat4 view(camera.view), clip_from_world = glm::dmat4(camera.projection) * view;
  // Right, up and towards the viewer, as the screen has them.
  const glm::dmat3 axes(glm::dvec3(row(clip_from_world, 0)), glm::dvec3(row(clip_from_world, 1)),
                        glm::dvec3(row(view, 2)));
  return glm::determinant(axes) < 0;
}

}  // namespace lkao::gl
