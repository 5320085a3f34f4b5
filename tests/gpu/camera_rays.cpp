#include "gpu/camera_rays.h"

#include <cstddef>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace lkao::gl::tests {
namespace {

// Where a ray meets a triangle, in units of the ray; infinity where it does not.
double distance_to(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& eye,
                   const glm::dvec3& ray) {
  const glm::dvec3 u = b - a, v = c - a, across = glm::cross(ray, v), from = eye - a, around = glm::cross(from, u);
  const double scale = 1 / glm::dot(u, across), x = glm::dot(from, across) * scale, y = glm::dot(ray, around) * scale;
  const double distance = glm::dot(v, around) * scale;
  return x >= 0 && y >= 0 && x + y <= 1 && distance > 0 ? distance : std::numeric_limits<double>::infinity();
}

// What a ray through a pixel's centre meets first. No normal where it meets nothing.
Receiver first_hit(const Mesh& mesh, const glm::dvec3& eye, const glm::dvec3& ray) {
  Receiver receiver;
  double nearest = std::numeric_limits<double>::infinity();
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    const double distance = distance_to(a, b, c, eye, ray);
    if (distance >= nearest) continue;
    nearest = distance;
    const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
    receiver.position = glm::vec3(eye + distance * ray);
    receiver.normal = glm::vec3(glm::dot(normal, ray) > 0 ? -normal : normal);
  }
  return receiver;
}

}  // namespace

std::vector<Receiver> cast_camera_rays(const Mesh& mesh, const Camera& camera, int width, int height) {
  const glm::dmat4 world_from_clip = glm::inverse(glm::dmat4(camera.projection) * glm::dmat4(camera.view));
  const glm::dvec3 eye(glm::inverse(glm::dmat4(camera.view))[3]);
  std::vector<Receiver> receivers;
  receivers.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const glm::dvec4 h =
          world_from_clip * glm::dvec4((2.0 * x + 1) / width - 1, (2.0 * y + 1) / height - 1, 0.0, 1.0);
      receivers.push_back(first_hit(mesh, eye, glm::dvec3(h) / h.w - eye));
    }
  }
  return receivers;
}

}  // namespace lkao::gl::tests
