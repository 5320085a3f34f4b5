// What the tests of the horizon pass look at, and how.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "gpu/horizon_definition.h"
#include "gpu/pixel_view.h"
#include "support/meshes.h"

namespace lkao::gl::tests {

inline constexpr HorizonEstimator kEstimators[] = {HorizonEstimator::horizons, HorizonEstimator::bitmask};

inline std::vector<float> draw_horizons(const PixelView& view, HorizonPass& pass, const HorizonOptions& options) {
  return view.draw([&](const OcclusionTarget& to) { pass.draw(view.g_buffer(), view.camera(), options, to); });
}

// The mean over so many seeds.
inline std::vector<double> draw_mean(const PixelView& view, HorizonPass& pass, HorizonOptions options, int seed_count) {
  std::vector<double> mean(view.pixels().size());
  for (int i = 0; i < seed_count; ++i, ++options.seed) {
    const std::vector<float> drawn = draw_horizons(view, pass, options);
    for (std::size_t pixel = 0; pixel < mean.size(); ++pixel) mean[pixel] += double{drawn[pixel]} / seed_count;
  }
  return mean;
}

// Options by which only slices are sampled, and many of them.
inline HorizonOptions converging(HorizonOptions options, const PixelView& view) {
  options.step_count = std::max(view.width(), view.height());
  options.slice_count = 32;
  return options;
}
inline std::vector<double> draw_converged(const PixelView& view, HorizonPass& pass, const HorizonOptions& options,
                                          int seed_count = 1) {
  return draw_mean(view, pass, converging(options, view), seed_count);
}

inline Camera looking(const glm::vec3& eye, const glm::vec3& target, float aspect, float fov = 0.9f) {
  const glm::vec3 up(0.01f, 1, 0.02f);
  return {glm::lookAt(eye, target, up), glm::perspective(fov, aspect, 0.1f, 50.0f)};
}

// Parallel rays, straight down onto x and z from -size to size.
inline Camera from_above(float size, float aspect) {
  return {glm::lookAt(glm::vec3(0, 10, 0), glm::vec3(0), glm::vec3(0, 0, -1)),
          glm::ortho(-size * aspect, size * aspect, -size, size, 0.1f, 20.0f)};
}

}  // namespace lkao::gl::tests
