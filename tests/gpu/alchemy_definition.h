// What the Alchemy pass computes, once more in double precision: Eq. 10 with Eq. 9's cut-off as an integral over the
// disc (M. McGuire et al., HPG 2011), by the pixels of a view or by rectangles as the camera sees them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include "gpu/pixel_view.h"
#include "lkao/gl/alchemy_pass.h"

namespace lkao::gl::tests {

// A point of the surface, in view space and the unit of the scene.
struct AlchemyReceiver {
  glm::dvec3 position, normal, geometric_normal;
  double bias = 0;
};

// ObscuranceFalloff, of a point `v` away, all in the unit of the scene.
inline double expected_term(const AlchemyReceiver& receiver, const glm::dvec3& v, const AlchemyOptions& options) {
  const double radius = options.radius, squared = glm::dot(v, v) / (radius * radius);
  const double height = (glm::dot(v, receiver.normal) - receiver.bias) / radius;
  if (squared >= 1 || height <= 0 || glm::dot(v, receiver.geometric_normal) <= receiver.bias) return 0;
  switch (options.falloff) {
    case ObscuranceFalloff::cut_off:
      break;
    case ObscuranceFalloff::smooth:
      return 5.0 / 3 * std::pow(1 - squared, 3) * height / (squared + options.epsilon);
    case ObscuranceFalloff::medium:
      return 20.0 / 3 * (1 - squared) * height;
    case ObscuranceFalloff::low:
      return 10.0 / 3 * height;
  }
  return height / (squared + options.epsilon);
}

// 1 - A of Eq. 10, of the mean of the terms over the disc.
inline double expected_occlusion(double mean, const AlchemyOptions& options) {
  return 1 - std::pow(std::fmax(1 - 2 * options.intensity * mean, 0.0), options.contrast);
}

// The mean over the disc around a pixel, of a view's every step-th pixel, by how much of the disc each pixel has.
class AlchemyDefinition {
 public:
  explicit AlchemyDefinition(const PixelView& view, int step = 1)
      : view_(view),
        is_perspective_(view.camera().projection[2][3] != 0),
        step_(step),
        width_((view.width() - 1) / step + 1),
        height_((view.height() - 1) / step + 1) {
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) seen_.push_back(seen_from_eye(step * x, step * y));
    }
  }

  int width() const { return width_; }
  int height() const { return height_; }

  // Of the pixels of the picture, with `background` where there is no receiver.
  std::vector<double> occlusion(const AlchemyOptions& options, double background = 0) const {
    std::vector<double> all;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const bool is_there = at(x, y).is_there();
        all.push_back(is_there ? expected_occlusion(mean(x, y, options), options) : background);
      }
    }
    return all;
  }

  double mean(int x, int y, const AlchemyOptions& options) const {
    const AlchemyReceiver receiver = receiver_at(x, y, options);
    const glm::dmat2 disc = disc_around(receiver.position, options);
    const glm::dmat2 from_pixels = glm::inverse(disc);
    const double area = std::fabs(glm::determinant(from_pixels));
    // Half of the diagonal of a pixel, in radii.
    const double reach = 1 + 0.5 * (glm::length(from_pixels[0]) + glm::length(from_pixels[1]));
    double sum = 0;
    for (int j = 0; j < height_; ++j) {
      for (int i = 0; i < width_; ++i) {
        const glm::dvec2 off(i - x, j - y);
        if (!at(i, j).is_there() || glm::length(from_pixels * off) > reach) continue;
        const double term = expected_term(receiver, at(i, j).position - receiver.position, options);
        if (term > 0) sum += term * area * mean_density(from_pixels, off, options.pattern);
      }
    }
    return sum;
  }

 private:
  SeenPixel seen_from_eye(int x, int y) const {
    const glm::dmat4 view(view_.camera().view);
    SeenPixel pixel = view_.pixels()[static_cast<std::size_t>(y * view_.width() + x)];
    pixel.position = glm::dvec3(view * glm::dvec4(pixel.position, 1));
    pixel.normal = glm::dmat3(view) * pixel.normal;
    pixel.geometric_normal = glm::dmat3(view) * pixel.geometric_normal;
    return pixel;
  }

  const SeenPixel& at(int x, int y) const { return seen_[static_cast<std::size_t>(y * width_ + x)]; }

  AlchemyReceiver receiver_at(int x, int y, const AlchemyOptions& options) const {
    const SeenPixel& pixel = at(x, y);
    const glm::dmat4 projection(view_.camera().projection);
    const double wide = std::fmax(view_.width(), view_.height());
    const double unit = std::fmax(2 / (view_.width() * glm::length(glm::dvec2(projection[0][0], projection[1][0]))),
                                  2 / (view_.height() * glm::length(glm::dvec2(projection[0][1], projection[1][1]))));
    const double distance = is_perspective_ ? -pixel.position.z : 0.5 * wide * unit;
    return {pixel.position, pixel.normal, pixel.geometric_normal, options.bias * distance};
  }

  // From the disc of radius 1 to pixels.
  glm::dmat2 disc_around(const glm::dvec3& position, const AlchemyOptions& options) const {
    const glm::dmat4 projection(view_.camera().projection);
    const double scale = 0.5 * options.radius / step_ / (is_perspective_ ? -position.z : 1);
    const glm::dvec2 size(view_.width(), view_.height());
    return {scale * size * glm::dvec2(projection[0]), scale * size * glm::dvec2(projection[1])};
  }

  // Of samples in a pixel, for each unit of area of the disc.
  static double mean_density(const glm::dmat2& from_pixels, const glm::dvec2& off, DiscPattern pattern) {
    constexpr int kSide = 10;
    double sum = 0;
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i) {
        const glm::dvec2 inside((i + 0.5) / kSide - 0.5, (j + 0.5) / kSide - 0.5);
        const double away = glm::length(from_pixels * (off + inside));
        if (away < 1) sum += pattern == DiscPattern::spiral ? 0.5 / away : 1.0;
      }
    }
    return sum / (kSide * kSide * std::numbers::pi);
  }

  const PixelView& view_;
  bool is_perspective_;
  int step_, width_, height_;
  std::vector<SeenPixel> seen_;
};

// The same of a rectangle that a camera without perspective sees all of, from `corner` along two sides at right angles;
// `towards_camera` is of unit length. An area takes as much of the disc as it is large when seen from the camera.
inline double mean_of_rectangle(const AlchemyReceiver& receiver, const glm::dvec3& corner, const glm::dvec3& side,
                                const glm::dvec3& other_side, const glm::dvec3& towards_camera,
                                const AlchemyOptions& options, int count = 400) {
  const double seen_area = std::fabs(glm::dot(glm::cross(side, other_side), towards_camera));
  double sum = 0;
  for (int j = 0; j < count; ++j) {
    for (int i = 0; i < count; ++i) {
      const glm::dvec3 p = corner + (i + 0.5) / count * side + (j + 0.5) / count * other_side;
      sum += expected_term(receiver, p - receiver.position, options);
    }
  }
  return sum * seen_area / (count * count * std::numbers::pi * options.radius * options.radius);
}

}  // namespace lkao::gl::tests
