#include "gpu/frame/view.h"

#include <epoxy/gl.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

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

// Pixels 0, step, 2 step ... of so many.
int answered_count(int size, int step) { return (size - 1) / step + 1; }

// Normalised device depth = z[0] + z[1] along for orthographic, z[0] + z[1] / along for perspective cameras.
struct DepthMap {
  double offset, slope;
};

DepthMap depth_map_of(const glm::mat4& projection, bool has_perspective) {
  const double a = projection[2][2], b = projection[3][2];
  return has_perspective ? DepthMap{-a, b} : DepthMap{b, -a};
}

glm::vec4 sizes(const glm::dvec4& v) { return glm::vec4(glm::abs(v)); }

// The length of the longest of the rays that go one unit along the view: it ends in a corner of the picture.
double longest_ray_of(const glm::dmat4& view_from_clip) {
  double longest = 0;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const glm::dvec4 h = view_from_clip * glm::dvec4(x, y, 0.5, 1);
      const glm::dvec3 corner = glm::dvec3(h) / h.w;
      longest = std::fmax(longest, glm::length(corner) / std::fabs(corner.z));
    }
  }
  return longest;
}

// From the clip space of the whole screen to that of the answered pixels. Pixel i stands for pixel step i, so its place
// i + 1/2 is where the whole screen has step i + 1/2.
glm::dmat4 answered_from_clip(const Pixels& pixels) {
  glm::dmat4 map(1);
  if (pixels.step == 1) return map;
  const int sizes[] = {pixels.width, pixels.height};
  for (int axis = 0; axis < 2; ++axis) {
    const double step = pixels.step, size = sizes[axis], answered = answered_count(sizes[axis], pixels.step);
    const double scale = size / (step * answered);
    map[axis][axis] = scale;
    map[3][axis] = scale + (1 - 1 / step) / answered - 1;
  }
  return map;
}

void describe_errors(const Camera& camera, const glm::dmat4& view_from_clip, const DepthMap& depth, int step,
                     ViewBlock& block) {
  const glm::dmat4 clip = glm::dmat4(camera.projection) * glm::dmat4(camera.view);
  block.clip_depth_size = sizes(row(clip, 2));
  block.clip_w_size = sizes(row(clip, 3));
  block.depth_offset = static_cast<float>(depth.offset);
  block.depth_slope = static_cast<float>(depth.slope);
  block.longest_ray = block.is_perspective != 0 ? static_cast<float>(longest_ray_of(view_from_clip)) : 1.0f;
  GLint subpixel_bits = 0;
  glGetIntegerv(GL_SUBPIXEL_BITS, &subpixel_bits);
  // Half a step of the grid along both axes, in pixels of the G-buffer.
  const float half_step = std::ldexp(std::numbers::sqrt2_v<float>, -subpixel_bits - 1);
  block.pixel_step = block.pixel_size / static_cast<float>(step) * half_step;
}

}  // namespace

ViewBlock make_view_block(const Camera& camera, const Pixels& pixels) {
  require_rigid(camera.view);
  const bool has_perspective = is_perspective(camera.projection);
  const DepthMap depth = depth_map_of(camera.projection, has_perspective);
  const glm::dmat4 view(camera.view), world_from_view = glm::inverse(view);
  const glm::dmat4 clip_from_view = answered_from_clip(pixels) * glm::dmat4(camera.projection);
  const glm::dmat4 view_from_clip = glm::inverse(clip_from_view);

  ViewBlock block{};
  block.world_from_clip = glm::inverse(clip_from_world(camera, pixels));
  block.world_from_view = world_from_view;
  block.clip_from_view = clip_from_view;
  block.view_from_clip = view_from_clip;
  block.view_from_world = camera.view;
  // The inverse of a rotation: its rows.
  for (int i = 0; i < 3; ++i) {
    block.world_from_normals[i] = glm::vec4(camera.view[0][i], camera.view[1][i], camera.view[2][i], 0);
  }
  block.view_depth = glm::vec4(-row(view, 2));
  block.eye = has_perspective ? glm::vec4(world_from_view[3]) : glm::vec4(-world_from_view[2]);
  block.width = answered_count(pixels.width, pixels.step);
  block.height = answered_count(pixels.height, pixels.step);
  block.step = 1;
  block.is_perspective = has_perspective;
  block.is_zero_to_one = camera.clip_depth == ClipDepth::zero_to_one;
  block.is_reversed = has_perspective ? depth.slope > 0 : depth.slope < 0;
  const double x = 2.0 / (pixels.width * glm::length(glm::dvec3(row(camera.projection, 0)) * glm::dvec3(1, 1, 0)));
  const double y = 2.0 / (pixels.height * glm::length(glm::dvec3(row(camera.projection, 1)) * glm::dvec3(1, 1, 0)));
  block.pixel_size = static_cast<float>(pixels.step * std::fmax(x, y));
  describe_errors(camera, view_from_clip, depth, pixels.step, block);
  return block;
}

glm::dmat4 clip_from_world(const Camera& camera, const Pixels& pixels) {
  return answered_from_clip(pixels) * glm::dmat4(camera.projection) * glm::dmat4(camera.view);
}

DepthEnds orthographic_depth_ends(const Camera& camera) {
  const DepthMap depth = depth_map_of(camera.projection, false);
  const double first = ((camera.clip_depth == ClipDepth::zero_to_one ? 0.0 : -1.0) - depth.offset) / depth.slope;
  const double second = (1.0 - depth.offset) / depth.slope;
  return {std::fmin(first, second), std::fmax(first, second)};
}

void dispatch_over_pixels(int width, int height) {
  glDispatchCompute(static_cast<GLuint>((width + 7) / 8), static_cast<GLuint>((height + 7) / 8), 1);
}

bool is_mirrored(const Camera& camera) {
  const glm::dmat4 view(camera.view), clip = glm::dmat4(camera.projection) * view;
  // Right, up and towards the viewer, as the screen has them.
  const glm::dmat3 axes(glm::dvec3(row(clip, 0)), glm::dvec3(row(clip, 1)), glm::dvec3(row(view, 2)));
  return glm::determinant(axes) < 0;
}

}  // namespace lkao::gl
