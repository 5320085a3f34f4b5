// What a camera sees, as textures and as numbers in double precision, for tests of passes in screen space.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "gpu/g_buffer_pass.h"
#include "lkao/gl/frame.h"
#include "lut/random.h"

namespace lkao::gl::tests {

// A pixel as it is seen, in world space; no normal where there is no receiver.
struct SeenPixel {
  glm::dvec3 position{0}, normal{0}, geometric_normal{0};

  bool is_there() const { return normal != glm::dvec3(0); }
};

// A picture of pixels, as textures and as numbers.
class PixelView {
 public:
  PixelView(const Camera& camera, int width, int height, const std::vector<SeenPixel>& pixels)
      : camera_(camera), width_(width), height_(height), pixels_(pixels) {
    positions_ = upload(&SeenPixel::position);
    normals_ = upload(&SeenPixel::normal);
    geometric_normals_ = upload(&SeenPixel::geometric_normal);
  }

  GBuffer g_buffer() const {
    return {.width = width_,
            .height = height_,
            .positions = positions_.name(),
            .normals = normals_.name(),
            .geometric_normals = geometric_normals_.name()};
  }
  const Camera& camera() const { return camera_; }
  const std::vector<SeenPixel>& pixels() const { return pixels_; }
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

  // The red components of what a pass writes to a target of this format: `draw(target)` runs it. Of every step-th pixel
  // where the pass is told so.
  template <typename Draw>
  std::vector<float> draw(const Draw& draw, int step = 1, GLenum format = GL_R32F, float background = 0) const {
    const int width = (width_ - 1) / step + 1, height = (height_ - 1) / step + 1;
    const Texture target = make_image(format, width, height);
    draw(OcclusionTarget{.texture = target.name(), .background = background});
    std::vector<float> occlusion;
    for (const glm::vec4& texel : read_image(target.name(), width, height)) occlusion.push_back(texel.x);
    return occlusion;
  }

 private:
  Texture upload(glm::dvec3 SeenPixel::*vector) const {
    std::vector<glm::vec4> texels;
    for (const SeenPixel& pixel : pixels_) texels.emplace_back(glm::vec3(pixel.*vector), 1);
    return make_image(GL_RGBA32F, width_, height_, &texels[0].x);
  }

  Camera camera_;
  int width_, height_;
  std::vector<SeenPixel> pixels_;
  Texture positions_, normals_, geometric_normals_;
};

// The line that a pixel's centre sees.
class SightLine {
 public:
  SightLine(const Camera& camera, int width, int height, int x, int y) {
    const glm::dmat4 world_from_clip = glm::inverse(glm::dmat4(camera.projection) * glm::dmat4(camera.view));
    const auto unproject = [&](double depth) {
      const glm::dvec4 h =
          world_from_clip * glm::dvec4((2.0 * x + 1) / width - 1, (2.0 * y + 1) / height - 1, depth, 1);
      return glm::dvec3(h) / h.w;
    };
    const auto along_view = [&](const glm::dvec3& p) { return -(glm::dmat4(camera.view) * glm::dvec4(p, 1)).z; };
    near_ = unproject(0.25), far_ = unproject(0.5);
    near_along_ = along_view(near_), far_along_ = along_view(far_);
  }

  // The point at a distance along the view.
  glm::dvec3 at(double along) const {
    return near_ + (far_ - near_) * ((along - near_along_) / (far_along_ - near_along_));
  }

 private:
  glm::dvec3 near_, far_;
  double near_along_, far_along_;
};

inline glm::dvec3 seen_at(const Camera& camera, int width, int height, int x, int y, double along) {
  return SightLine(camera, width, height, x, y).at(along);
}

// Pixels that see points at all distances, one in eight nothing, with normals of all directions.
inline PixelView random_view(const Camera& camera, int width, int height, std::uint64_t seed) {
  lut::RandomStream random(seed);
  std::vector<SeenPixel> pixels(static_cast<std::size_t>(width * height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (random.next_below(8) == 0) continue;
      SeenPixel& pixel = pixels[static_cast<std::size_t>(y * width + x)];
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
PixelView view_of_ground(Height height, int width, int image_height) {
  const Camera camera = straight_camera();
  std::vector<SeenPixel> pixels(static_cast<std::size_t>(width * image_height));
  for (int y = 0; y < image_height; ++y) {
    for (int x = 0; x < width; ++x) {
      const SightLine line(camera, width, image_height, x, y);
      double low = 0.05, high = 30;
      if (line.at(high).y > height(line.at(high).x, line.at(high).z)) continue;
      for (int i = 0; i < 80; ++i) {
        const double middle = 0.5 * (low + high);
        const glm::dvec3 p = line.at(middle);
        (p.y > height(p.x, p.z) ? low : high) = middle;
      }
      const glm::dvec3 p = line.at(low);
      const double step = 1e-4;
      const glm::dvec3 normal =
          glm::normalize(glm::dvec3((height(p.x - step, p.z) - height(p.x + step, p.z)) / (2 * step), 1,
                                    (height(p.x, p.z - step) - height(p.x, p.z + step)) / (2 * step)));
      pixels[static_cast<std::size_t>(y * width + x)] = {glm::vec3(p), glm::vec3(normal), glm::vec3(normal)};
    }
  }
  return {camera, width, image_height, pixels};
}

// What the centres of pixels see of a mesh, by trying all triangles; positions and normals are those of the planes to
// the last bit of a float. Normals face the camera.
inline PixelView view_of_mesh(const Mesh& mesh, const Camera& camera, int width, int height) {
  std::vector<SeenPixel> pixels(static_cast<std::size_t>(width * height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const SightLine line(camera, width, height, x, y);
      const glm::dvec3 from = line.at(1), along = line.at(2) - from;
      double nearest = std::numeric_limits<double>::infinity();
      for (const glm::uvec3& triangle : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[triangle.x]), b(mesh.positions[triangle.y]), c(mesh.positions[triangle.z]);
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double t = glm::dot(a - from, normal) / glm::dot(along, normal);
        const glm::dvec3 p = from + t * along;
        const bool is_inside = glm::dot(glm::cross(b - a, p - a), normal) >= 0 &&
                               glm::dot(glm::cross(c - b, p - b), normal) >= 0 &&
                               glm::dot(glm::cross(a - c, p - c), normal) >= 0;
        // The eye of a perspective camera lies at distance 0: t = -1.
        if (!is_inside || !(t > -1) || t >= nearest) continue;
        nearest = t;
        const glm::dvec3 facing = glm::normalize(glm::dot(along, normal) > 0 ? -normal : normal);
        pixels[static_cast<std::size_t>(y * width + x)] = {p, facing, facing};
      }
    }
  }
  return {camera, width, height, pixels};
}

}  // namespace lkao::gl::tests
