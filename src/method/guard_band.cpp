#include "method/guard_band.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/trigonometric.hpp>

namespace lkao::method {
namespace {

// Field of view that shows so many pixels where `camera` shows `width`, of the same size in the image plane.
float wider_fov(const scene::Camera& camera, int width, int wider_width) {
  const double half_width = std::tan(glm::radians(double{camera.fov}) / 2);
  return static_cast<float>(glm::degrees(2 * std::atan(half_width * wider_width / width)));
}

}  // namespace

GuardedView widen(const scene::Mesh& mesh, const scene::Camera& camera, const scene::ReceiverImage& image, int margin) {
  const int width = image.width + 2 * margin, height = image.height + 2 * margin;
  GuardedView wide{camera, {}};
  wide.camera.fov = wider_fov(camera, image.width, width);
  wide.image = scene::find_receivers(mesh, wide.camera, width, height);
  for (int y = 0; y < image.height; ++y) {
    const auto from = std::ptrdiff_t{y} * image.width, to = std::ptrdiff_t{y + margin} * width + margin;
    std::copy_n(image.receivers.begin() + from, image.width, wide.image.receivers.begin() + to);
    std::copy_n(image.depth.begin() + from, image.width, wide.image.depth.begin() + to);
  }
  return wide;
}

std::vector<float> without_margin(const std::vector<float>& frame, int width, int margin) {
  const std::ptrdiff_t wider = width, inner = wider - 2 * margin;
  const auto height = static_cast<std::ptrdiff_t>(frame.size()) / wider - 2 * margin;
  std::vector<float> middle;
  for (std::ptrdiff_t y = 0; y < height; ++y) {
    const auto row = frame.begin() + (y + margin) * wider + margin;
    middle.insert(middle.end(), row, row + inner);
  }
  return middle;
}

}  // namespace lkao::method
