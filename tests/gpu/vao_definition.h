// What the VAO pass is to find, once more in double precision.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include "gpu/pixel_view.h"
#include "gpu/screen/vao/sample_sets.h"
#include "lkao/gl/vao_pass.h"

namespace lkao::gl::tests {

// Of the pixels of a view, or of every step-th of them.
class VaoDefinition {
 public:
  explicit VaoDefinition(const PixelView& view, int step = 1)
      : view_(view), step_(step), width_((view.width() - 1) / step + 1), height_((view.height() - 1) / step + 1) {
    const glm::dmat4 view_from_world(view.camera().view);
    const auto in_view = [&](const glm::dvec3& p) { return glm::dvec3(view_from_world * glm::dvec4(p, 1)); };
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const SightLine line(view.camera(), view.width(), view.height(), step * x, step * y);
        const glm::dvec3 begin = in_view(line.at(1));
        lines_.push_back({begin, in_view(line.at(2)) - begin, -in_view(seen(x, y).position).z - 1});
      }
    }
  }

  int width() const { return width_; }
  int height() const { return height_; }
  const SeenPixel& seen(int x, int y) const {
    return view_.pixels()[static_cast<std::size_t>(step_ * y * view_.width() + step_ * x)];
  }

  // In view space: the ball of a pixel's receiver, which may be none of the view's.
  struct Ball {
    glm::dvec3 centre;
    double radius;
  };
  Ball ball(int x, int y, const VaoOptions& options) const {
    const glm::dmat4 view(view_.camera().view);
    const glm::dvec3 position(view * glm::dvec4(seen(x, y).position, 1));
    const glm::dvec3 normal = glm::dmat3(view) * glm::normalize(seen(x, y).normal);
    double radius = 0.5 * double{options.radius};
    if (is_perspective()) radius = std::fmin(radius, -position.z / (1 + std::fmax(normal.z, 0)));
    return {position + radius * normal, radius};
  }

  // The pixel of the picture that a place of the ball's disc lies in; none beyond the picture.
  std::optional<glm::ivec2> pixel_of(const Ball& ball, const glm::dvec2& place) const {
    const glm::dvec4 clip =
        glm::dmat4(view_.camera().projection) * glm::dvec4(ball.centre + ball.radius * glm::dvec3(place, 0), 1);
    const glm::ivec2 pixel(pixel_of(clip.x / clip.w, view_.width()), pixel_of(clip.y / clip.w, view_.height()));
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= width_ || pixel.y >= height_) return std::nullopt;
    return pixel;
  }

  // The occlusion by lines of view through these places of the unit disc.
  double occlusion(int x, int y, const VaoOptions& options, const std::vector<glm::dvec2>& places) const {
    const Ball ball = this->ball(x, y, options);
    const auto& [centre, radius] = ball;
    double free = 0, whole = 0;
    for (const glm::dvec2& place : places) {
      const std::optional<glm::ivec2> pixel = pixel_of(ball, place);
      if (!pixel) continue;
      // The line of view through the middle of the pixel.
      const auto& [a, along, depth] = lines_[static_cast<std::size_t>(pixel->y * width_ + pixel->x)];
      const double middle = glm::dot(centre - a, along) / glm::dot(along, along);
      const glm::dvec3 off = centre - a - middle * along;
      const double squared = (radius * radius - glm::dot(off, off)) / glm::dot(along, along);
      if (squared <= 0) continue;
      const double half = std::sqrt(squared), begin = middle - half, end = middle + half;
      whole += end - begin;
      if (!seen(pixel->x, pixel->y).is_there() || depth >= end) {
        free += end - begin;
      } else if (depth > begin) {
        free += depth - begin;
      } else {
        free += (end - begin) * (1 - blocked_behind(begin - depth, options));
      }
    }
    return whole > 0 ? 1 - free / whole : 0;
  }

  // How many samples sets have there (Sec. 4.1).
  int set_size(int x, int y, const VaoOptions& options) const {
    const Ball ball = this->ball(x, y, options);
    const double pixel =
        step_ *
        view_.pixel_width(glm::dvec3(glm::inverse(glm::dmat4(view_.camera().view)) * glm::dvec4(ball.centre, 1)));
    const double share = 2 * ball.radius / (pixel * std::min(width_, height_)) / double{options.fewest_samples_width};
    int size = 2;
    for (double area = 2; area <= share * share && size < options.sample_count; area *= 2) size *= 2;
    return size;
  }

  // By many places of the disc.
  double converged(int x, int y, const VaoOptions& options) const { return occlusion(x, y, options, all_places()); }

  // The set of a pixel, turned as the pass does it.
  static std::vector<glm::dvec2> set_of(int x, int y, int size) {
    std::vector<glm::dvec2> places;
    const double angle = (x % 3 + 3 * (y % 3)) * 2 * std::numbers::pi / 9;
    for (int i = 0; i < size; ++i) {
      const glm::dvec2 p(sample_sets()[static_cast<std::size_t>(size - 2 + i)]);
      places.emplace_back(std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y);
    }
    return places;
  }

 private:
  static double blocked_behind(double distance, const VaoOptions& options) {
    if (std::isinf(options.thickness)) return 1;
    const double u = options.thickness;
    return u / std::fmax(u, distance / double{options.radius});
  }

  static const std::vector<glm::dvec2>& all_places() {
    static const std::vector<glm::dvec2> places = [] {
      constexpr int kSide = 90;
      std::vector<glm::dvec2> all;
      for (int i = 0; i < kSide * kSide; ++i) {
        const glm::dvec2 p((2.0 * (i % kSide) + 1) / kSide - 1, (2.0 * (i / kSide) + 1) / kSide - 1);
        if (glm::dot(p, p) < 1) all.push_back(p);
      }
      return all;
    }();
    return places;
  }

  // Pixel i stands for pixel step i of the view.
  int pixel_of(double clip, int size) const {
    const double place = 0.5 * (clip + 1) * size;
    return static_cast<int>(std::floor((place - 0.5) / step_ + 0.5));
  }
  bool is_perspective() const { return view_.camera().projection[2][3] != 0; }

  // A line of view: where it is 1 along the view, how it goes on from there, and how far it sees, in units of that.
  struct Line {
    glm::dvec3 begin, along;
    double depth;
  };

  const PixelView& view_;
  int step_, width_, height_;
  std::vector<Line> lines_;
};

inline std::vector<float> draw_vao(const PixelView& view, VaoPass& pass, const VaoOptions& options, int step = 1,
                                   GLenum format = GL_R32F, float background = 0) {
  GBuffer g_buffer = view.g_buffer();
  g_buffer.step = step;
  return view.draw([&](const OcclusionTarget& to) { pass.draw(g_buffer, view.camera(), options, to); }, step, format,
                   background);
}

// Every sample of a set, and nothing left out.
inline VaoOptions plain_set(float radius, int size) {
  return {.radius = radius, .sample_count = size, .fewest_samples_width = 0, .culling = VaoCulling::off};
}

// Its own assumptions, nearly solved.
inline VaoOptions converged_vao(float radius) { return plain_set(radius, 4096); }

}  // namespace lkao::gl::tests
