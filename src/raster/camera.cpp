#include "raster/camera.h"

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

namespace lkao::raster {

gl::Camera gl_camera(const scene::Camera& camera, int width, int height) {
  const double half_width = std::tan(0.5 * glm::radians(static_cast<double>(camera.fov)));
  const double half_height = half_width * height / width;
  glm::dmat4 projection(0);
  projection[0][0] = 1 / half_width;
  projection[1][1] = -1 / half_height;
  // Near plane at 1, far plane at infinity; any would do.
  projection[2][2] = -1;
  projection[2][3] = -1;
  projection[3][2] = -2;
  const glm::dmat4 view = glm::lookAt(glm::dvec3(camera.eye), glm::dvec3(camera.target), glm::dvec3(camera.up));
  return {glm::mat4(view), glm::mat4(projection), gl::ClipDepth::minus_one_to_one};
}

}  // namespace lkao::raster
