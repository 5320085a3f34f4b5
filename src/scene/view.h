// The rays of a camera through its image.
#pragma once

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

#include "scene/camera.h"

namespace lkao::scene {

// The right-handed frame of a camera; a ray through the image is forward + x right + y up.
struct View {
  glm::dvec3 eye;
  glm::dvec3 forward;  // unit
  glm::dvec3 right;    // of the length of half the image's width at distance 1
  glm::dvec3 up;       // of the same length
};

inline View view_of(const Camera& camera) {
  const glm::dvec3 eye(camera.eye);
  const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.target) - eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::normalize(glm::dvec3(camera.up))));
  const double half_width = std::tan(0.5 * glm::radians(static_cast<double>(camera.fov)));
  return {eye, forward, half_width * right, half_width * glm::cross(right, forward)};
}

// Through the centre of a pixel of an image of that size.
inline glm::dvec3 pixel_direction(const View& view, int width, int height, int column, int row) {
  const double x = (2 * column + 1 - width) / static_cast<double>(width);
  const double y = (height - 2 * row - 1) / static_cast<double>(width);
  return view.forward + x * view.right + y * view.up;
}

}  // namespace lkao::scene
