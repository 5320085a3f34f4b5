// What the filters know of pixels, in double precision, from positions in view space.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/geometric.hpp>

#include "gpu/g_buffer_pass.h"
#include "lkao/gl/bilateral_filter.h"

namespace lkao::gl::tests {

class ViewSurfaces {
 public:
  ViewSurfaces(const std::vector<Receiver>& receivers, const Camera& camera, int width, int height)
      : is_perspective_(camera.projection[2][3] != 0),
        pixel_size_(std::fmax(2.0 / (width * std::fabs(double{camera.projection[0][0]})),
                              2.0 / (height * std::fabs(double{camera.projection[1][1]})))) {
    for (const Receiver& receiver : receivers) {
      const bool is_valid = receiver.normal != glm::vec3(0);
      positions_.emplace_back(camera.view * glm::vec4(receiver.position, 1));
      const glm::dvec3 normal(glm::mat3(camera.view) * receiver.normal);
      normals_.push_back(is_valid ? glm::normalize(normal) : glm::dvec3(0));
    }
  }

  bool has_receiver(std::size_t i) const { return normals_[i] != glm::dvec3(0); }

  double likeness(std::size_t middle, std::size_t other, const BilateralFilterOptions& options) const {
    const double pixel = pixel_size_ * (is_perspective_ ? -positions_[middle].z : 1.0);
    const double off =
        glm::dot(normals_[middle], positions_[other] - positions_[middle]) / (pixel * options.depth_tolerance);
    const double alike =
        std::pow(std::fmax(glm::dot(normals_[middle], normals_[other]), 0.0), options.normal_sharpness);
    return std::exp(-off * off) * alike;
  }

 private:
  bool is_perspective_;
  double pixel_size_;
  std::vector<glm::dvec3> positions_, normals_;  // unit normals; zero where there is no receiver
};

// The weight of what is so many pixels away, by the square of that.
inline double gauss_weight(double squared_distance, const BilateralFilterOptions& options) {
  return std::pow(0.1, squared_distance / (options.radius * options.radius));
}

}  // namespace lkao::gl::tests
