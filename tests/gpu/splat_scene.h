// The definition of the splat pass once more, in double precision.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>

#include "gpu/pixel_view.h"
#include "lkao/gl/splat_pass.h"

namespace lkao::gl::tests {

// The red components of what the pass writes.
inline std::vector<float> draw_splats(const PixelView& view, SplatPass& pass, const SplatOptions& options,
                                      const PixelView* behind = nullptr, GLenum format = GL_R32F,
                                      float background = 0) {
  const GBuffer second = behind != nullptr ? behind->g_buffer() : GBuffer{};
  const auto draw = [&](const OcclusionTarget& to) {
    pass.draw(view.g_buffer(), view.camera(), options, to, behind != nullptr ? &second : nullptr);
  };
  return view.draw(draw, 1, format, background);
}

// SphereFormula for r / d = `sine`.
inline double expected_share(SphereFormula formula, double sine, double cosine) {
  const double cap = 2 * (1 - std::cos(std::asin(std::min(sine, 1.0))));
  const double factor = formula == SphereFormula::exact     ? sine * sine
                        : formula == SphereFormula::printed ? std::numbers::pi * cap
                                                            : cap;
  return factor * std::fmax(cosine, 0.0);
}

// The sum of the far half, not cut off.
inline double expected_far(const SeenPixel& pixel, const std::vector<glm::vec4>& spheres, const SplatOptions& options) {
  double sum = 0;
  for (const glm::vec4& sphere : spheres) {
    const glm::dvec3 to = glm::dvec3(sphere) - pixel.position;
    const double distance = glm::length(to), radius = sphere.w;
    if (distance >= radius * sphere_reach(options.epsilon, options.formula)) continue;
    if (distance <= radius) {
      sum += options.inside == InsideSphere::everything ? 1 : 0;
      continue;
    }
    const double nearest =
        std::fmax(options.near_half ? options.near_radius : 0, options.inside == InsideSphere::faded ? 2 * radius : 0);
    const double begin = std::fmax(distance - radius, nearest);
    const double end = std::fmin(distance + radius, options.far_radius);
    sum += std::clamp((end - begin) / (2 * radius), 0.0, 1.0) *
           expected_share(options.formula, radius / distance, glm::dot(pixel.normal, to) / distance);
  }
  return sum;
}

// The sum of the near half over all pixels of the disc, in one layer of the scene or more.
inline double expected_near(const PixelView& view, std::size_t index, const std::vector<const PixelView*>& layers,
                            const SplatOptions& options) {
  const SeenPixel& receiver = view.pixels()[index];
  const auto width = static_cast<std::size_t>(view.width());
  const double disc = options.near_radius / view.pixel_width(receiver.position);
  double sum = 0;
  for (const PixelView* layer : layers) {
    for (std::size_t i = 0; i < layer->pixels().size(); ++i) {
      const SeenPixel& pixel = layer->pixels()[i];
      const double x = static_cast<double>(i % width) - static_cast<double>(index % width);
      const double y = static_cast<double>(i / width) - static_cast<double>(index / width);
      if (!pixel.is_there() || x * x + y * y > disc * disc) continue;
      const double radius = options.pixel_sphere_radius * view.pixel_width(pixel.position);
      const glm::dvec3 to = pixel.position - radius * pixel.geometric_normal - receiver.position;
      const double distance = glm::length(to);
      if (distance >= options.near_radius || glm::dot(receiver.geometric_normal, to) <= 0) continue;
      sum += expected_share(options.formula, radius / distance, glm::dot(receiver.normal, to) / distance);
    }
  }
  return sum;
}

}  // namespace lkao::gl::tests
