// What the tests of the splat pass look at, and its definition once more, in double precision.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "gpu/g_buffer_pass.h"
#include "lkao/gl/splat_pass.h"
#include "lut/random.h"

namespace lkao::gl::tests {

// A pixel as it is seen, in world space; no normal where there is no receiver.
struct SplatPixel {
  glm::dvec3 position{0}, normal{0}, geometric_normal{0};

  bool is_there() const { return normal != glm::dvec3(0); }
};

// A picture of pixels, as textures and as numbers.
class SplatView {
 public:
  SplatView(const Camera& camera, int width, int height, const std::vector<SplatPixel>& pixels)
      : camera_(camera), width_(width), height_(height), pixels_(pixels) {
    positions_ = upload(&SplatPixel::position);
    normals_ = upload(&SplatPixel::normal);
    geometric_normals_ = upload(&SplatPixel::geometric_normal);
  }

  GBuffer g_buffer() const {
    return {.width = width_,
            .height = height_,
            .positions = positions_.name(),
            .normals = normals_.name(),
            .geometric_normals = geometric_normals_.name()};
  }
  const Camera& camera() const { return camera_; }
  const std::vector<SplatPixel>& pixels() const { return pixels_; }
  int width() const { return width_; }
  int height() const { return height_; }

  // Of the world, that a pixel is wide at a point.
  double pixel_width(const glm::dvec3& point) const {
    const double size =
        std::fmax(2.0 / (width_ * double{glm::length(glm::vec2(camera_.projection[0][0], camera_.projection[1][0]))}),
                  2.0 / (height_ * double{glm::length(glm::vec2(camera_.projection[0][1], camera_.projection[1][1]))}));
    const bool is_perspective = camera_.projection[2][3] != 0;
    return size * (is_perspective ? -(glm::dmat4(camera_.view) * glm::dvec4(point, 1)).z : 1.0);
  }

  // The red components of what the pass writes.
  std::vector<float> draw(SplatPass& pass, const SplatOptions& options, const SplatView* behind = nullptr,
                          GLenum format = GL_R32F, float background = 0) const {
    const Texture target = make_image(format, width_, height_);
    const GBuffer second = behind != nullptr ? behind->g_buffer() : GBuffer{};
    pass.draw(g_buffer(), camera_, options, {target.name(), background}, behind != nullptr ? &second : nullptr);
    std::vector<float> occlusion;
    for (const glm::vec4& texel : read_image(target.name(), width_, height_)) occlusion.push_back(texel.x);
    return occlusion;
  }

 private:
  Texture upload(glm::dvec3 SplatPixel::*vector) const {
    std::vector<glm::vec4> texels;
    for (const SplatPixel& pixel : pixels_) texels.emplace_back(glm::vec3(pixel.*vector), 1);
    return make_image(GL_RGBA32F, width_, height_, &texels[0].x);
  }

  Camera camera_;
  int width_, height_;
  std::vector<SplatPixel> pixels_;
  Texture positions_, normals_, geometric_normals_;
};

// The point at a distance along the view that a pixel's centre sees.
inline glm::dvec3 seen_at(const Camera& camera, int width, int height, int x, int y, double along) {
  const glm::dmat4 world_from_clip = glm::inverse(glm::dmat4(camera.projection) * glm::dmat4(camera.view));
  const auto unproject = [&](double depth) {
    const glm::dvec4 h = world_from_clip * glm::dvec4((2.0 * x + 1) / width - 1, (2.0 * y + 1) / height - 1, depth, 1);
    return glm::dvec3(h) / h.w;
  };
  const auto along_view = [&](const glm::dvec3& p) { return -(glm::dmat4(camera.view) * glm::dvec4(p, 1)).z; };
  const glm::dvec3 a = unproject(0.25), b = unproject(0.5);
  return a + (b - a) * ((along - along_view(a)) / (along_view(b) - along_view(a)));
}

// Pixels that see points at all distances, one in eight nothing, with normals of all directions.
inline SplatView random_view(const Camera& camera, int width, int height, std::uint64_t seed) {
  lut::RandomStream random(seed);
  std::vector<SplatPixel> pixels(static_cast<std::size_t>(width * height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (random.next_below(8) == 0) continue;
      SplatPixel& pixel = pixels[static_cast<std::size_t>(y * width + x)];
      pixel.position = glm::vec3(seen_at(camera, width, height, x, y, 1 + 7 * random.next_double()));
      pixel.normal = pixel.geometric_normal = lkao::tests::random_direction(random);
    }
  }
  return {camera, width, height, pixels};
}

// Looks along -z from the origin.
inline Camera straight_camera() { return {glm::mat4(1), glm::perspective(1.0f, 4.0f / 3, 0.1f, 50.0f)}; }

// What the centres of pixels see of a ground, y as a function of x and z that is below 0. Found by halving: nothing of
// it may hide something else.
template <typename Height>
SplatView view_of_ground(Height height, int width, int image_height) {
  const Camera camera = straight_camera();
  std::vector<SplatPixel> pixels(static_cast<std::size_t>(width * image_height));
  for (int y = 0; y < image_height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto at = [&](double along) { return seen_at(camera, width, image_height, x, y, along); };
      double low = 0.05, high = 30;
      if (at(high).y > height(at(high).x, at(high).z)) continue;
      for (int i = 0; i < 80; ++i) {
        const double middle = 0.5 * (low + high);
        const glm::dvec3 p = at(middle);
        (p.y > height(p.x, p.z) ? low : high) = middle;
      }
      const glm::dvec3 p = at(low);
      const double step = 1e-4;
      const glm::dvec3 normal =
          glm::normalize(glm::dvec3((height(p.x - step, p.z) - height(p.x + step, p.z)) / (2 * step), 1,
                                    (height(p.x, p.z - step) - height(p.x, p.z + step)) / (2 * step)));
      pixels[static_cast<std::size_t>(y * width + x)] = {glm::vec3(p), glm::vec3(normal), glm::vec3(normal)};
    }
  }
  return {camera, width, image_height, pixels};
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
inline double expected_far(const SplatPixel& pixel, const std::vector<glm::vec4>& spheres,
                           const SplatOptions& options) {
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
inline double expected_near(const SplatView& view, std::size_t index, const std::vector<const SplatView*>& layers,
                            const SplatOptions& options) {
  const SplatPixel& receiver = view.pixels()[index];
  const auto width = static_cast<std::size_t>(view.width());
  const double disc = options.near_radius / view.pixel_width(receiver.position);
  double sum = 0;
  for (const SplatView* layer : layers) {
    for (std::size_t i = 0; i < layer->pixels().size(); ++i) {
      const SplatPixel& pixel = layer->pixels()[i];
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
