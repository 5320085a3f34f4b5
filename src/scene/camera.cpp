#include "scene/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "lut/coordinates.h"
#include "scene/facet.h"
#include "scene/first_hits.h"
#include "scene/view.h"

namespace lkao::scene {

namespace {

Receiver receiver_at(const CornerNormals& normals, const SurfaceHit& hit, const glm::dvec3& eye) {
  const Mesh& mesh = normals.mesh();
  const Facet facet(mesh, mesh.triangles[hit.triangle]);
  const glm::dvec3& w = hit.weights;
  const glm::dvec3 position = w.x * glm::dvec3(facet.a) + w.y * glm::dvec3(facet.b) + w.z * glm::dvec3(facet.c);
  const auto [facet_normal, corners] = normals.of(hit.triangle);
  const double side = glm::dot(facet_normal, eye - position) < 0 ? -1 : 1;
  Receiver receiver;
  receiver.position = glm::vec3(position);
  receiver.normal = glm::vec3(side * facet_normal);
  if (normals.source() == NormalSource::facet) return receiver;
  receiver.geometric_normal = receiver.normal;
  const glm::dvec3 normal = w.x * glm::dvec3(corners[0]) + w.y * glm::dvec3(corners[1]) + w.z * glm::dvec3(corners[2]);
  receiver.normal = glm::vec3(side * glm::normalize(normal));
  return receiver;
}

void check_size(int width, int height) {
  constexpr int kLargest = 1 << 15;
  if (width < 1 || height < 1 || width > kLargest || height > kLargest) {
    throw std::invalid_argument(
        fmt::format("find_receivers: size {}x{} is outside 1x1 to {}x{}", width, height, kLargest, kLargest));
  }
}

bool is_along(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::length(glm::cross(glm::normalize(a), glm::normalize(b))) < 1e-6;
}

// From in front, to the right and somewhat above. "In front" is +z, or -y where z is up.
glm::dvec3 three_quarter_direction(const glm::dvec3& up) {
  const glm::dvec3 up_axis = glm::normalize(up);
  const glm::dvec3 seed = std::abs(up_axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, -1, 0);
  const glm::dvec3 front = glm::normalize(seed - glm::dot(seed, up_axis) * up_axis);
  const glm::dvec3 side = glm::cross(up_axis, front);
  return glm::normalize(front + 0.7 * side + 0.55 * up_axis);
}

// The nearest distance from the middle of the box at which all eight corners are inside the image.
double distance_to_fit(const Bounds& bounds, const glm::dvec3& to_eye, const glm::dvec3& up, double aspect, float fov) {
  const glm::dvec3 half = 0.5 * (glm::dvec3(bounds.upper) - glm::dvec3(bounds.lower));
  const glm::dvec3 right = glm::normalize(glm::cross(-to_eye, glm::normalize(up)));
  const glm::dvec3 top = glm::cross(right, -to_eye);
  const double tan_x = std::tan(0.5 * glm::radians(static_cast<double>(fov)));
  const double tan_y = tan_x / aspect;
  double distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 sign((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1);
    const glm::dvec3 offset = sign * half;
    const double nearness = glm::dot(offset, to_eye);
    distance = std::max(distance, nearness + std::abs(glm::dot(offset, right)) / tan_x);
    distance = std::max(distance, nearness + std::abs(glm::dot(offset, top)) / tan_y);
  }
  return distance > 0 ? distance : 1;  // 1 for a box that is a single point
}

// What casts the rays of pixels.
class Tracer {
 public:
  Tracer(const Mesh& mesh, NormalSource normals) : normals_(mesh, normals), hits_(mesh) {}

  // Where nothing is hit: none.
  std::optional<Receiver> first(const glm::dvec3& eye, const glm::dvec3& direction, double near) const {
    const std::optional<SurfaceHit> hit = hits_.cast(eye, direction, near);
    if (!hit) return std::nullopt;
    return receiver_at(normals_, *hit, eye);
  }

 private:
  CornerNormals normals_;
  FirstHits hits_;
};

ReceiverImage empty_image(int width, int height) {
  const std::size_t pixel_count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  ReceiverImage image;
  image.width = width;
  image.height = height;
  image.depth.assign(pixel_count, std::numeric_limits<float>::infinity());
  image.receivers.assign(pixel_count, Receiver{.position = glm::vec3(std::numeric_limits<float>::quiet_NaN())});
  return image;
}

// Fills an empty image. `near_of(pixel)` is where its ray begins, along the view; none: it is not cast.
template <class NearOf>
void trace(const Tracer& tracer, const View& view, ReceiverImage& image, const NearOf& near_of) {
  tbb::parallel_for(0, image.height, [&](int row) {
    for (int column = 0; column < image.width; ++column) {
      const std::size_t pixel =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(column);
      const std::optional<double> near = near_of(pixel);
      if (!near) continue;
      const glm::dvec3 direction = pixel_direction(view, image.width, image.height, column, row);
      const std::optional<Receiver> receiver = tracer.first(view.eye, direction, *near);
      if (!receiver) continue;
      image.receivers[pixel] = *receiver;
      image.depth[pixel] = static_cast<float>(glm::dot(glm::dvec3(receiver->position) - view.eye, view.forward));
    }
  });
  for (std::size_t pixel = 0; pixel < image.receivers.size(); ++pixel) {
    image.receiver_count += image.sees(pixel) ? 1 : 0;
  }
}

}  // namespace

void validate(const Camera& camera) {
  const auto fail = [](const std::string& what) { throw std::invalid_argument("camera: " + what); };
  const auto text = [](const glm::vec3& v) { return fmt::format("({}, {}, {})", v.x, v.y, v.z); };
  if (!lut::is_finite(camera.eye)) fail("eye is not finite: " + text(camera.eye));
  if (!lut::is_finite(camera.target)) fail("target is not finite: " + text(camera.target));
  if (!lut::is_finite(camera.up)) fail("up is not finite: " + text(camera.up));
  if (!(camera.fov > 0 && camera.fov < 180)) fail(fmt::format("fov is {} degrees, not between 0 and 180", camera.fov));
  if (camera.eye == camera.target) fail("eye and target are the same point " + text(camera.eye));
  if (camera.up == glm::vec3(0.0f)) fail("up is zero");
  if (is_along(glm::dvec3(camera.target) - glm::dvec3(camera.eye), glm::dvec3(camera.up))) {
    fail("up " + text(camera.up) + " points along the view");
  }
}

Camera frame(const Bounds& bounds, float aspect, const glm::vec3& up, float fov) {
  if (!lut::is_finite(bounds.lower) || !lut::is_finite(bounds.upper)) {
    throw std::invalid_argument("frame: there is nothing to look at, the bounds are empty or not finite");
  }
  if (!(aspect > 0) || !std::isfinite(aspect)) throw std::invalid_argument(fmt::format("frame: aspect is {}", aspect));
  if (!lut::is_finite(up) || up == glm::vec3(0.0f)) throw std::invalid_argument("frame: up is zero or not finite");
  if (!(fov > 0 && fov < 180)) throw std::invalid_argument(fmt::format("frame: fov is {} degrees", fov));

  const glm::dvec3 to_eye = three_quarter_direction(glm::dvec3(up));
  const glm::dvec3 center = 0.5 * (glm::dvec3(bounds.lower) + glm::dvec3(bounds.upper));
  constexpr double kMargin = 1.03;
  const double distance = kMargin * distance_to_fit(bounds, to_eye, glm::dvec3(up), static_cast<double>(aspect), fov);
  Camera camera;
  camera.eye = glm::vec3(center + distance * to_eye);
  camera.target = glm::vec3(center);
  camera.up = up;
  camera.fov = fov;
  return camera;
}

ReceiverImage find_receivers(const Mesh& mesh, const Camera& camera, int width, int height, NormalSource normals) {
  validate(camera);
  check_size(width, height);
  ReceiverImage image = empty_image(width, height);
  trace(Tracer(mesh, normals), view_of(camera), image, [](std::size_t) { return std::optional(0.0); });
  return image;
}

ReceiverImage find_behind(const Mesh& mesh, const Camera& camera, const ReceiverImage& image) {
  // A tenth of a pixel's width in a picture of 1000: what is so near is the same surface.
  constexpr double kBeyond = 1 + 1e-4;
  const View view = view_of(camera);
  const Tracer tracer(mesh, NormalSource::facet);
  ReceiverImage behind = empty_image(image.width, image.height);
  trace(tracer, view, behind, [&](std::size_t pixel) -> std::optional<double> {
    if (!image.sees(pixel)) return std::nullopt;
    // Directions go one unit along the view.
    return kBeyond * static_cast<double>(image.depth[pixel]);
  });
  return behind;
}

std::vector<Receiver> seen_receivers(const ReceiverImage& image) {
  std::vector<Receiver> receivers;
  receivers.reserve(image.receiver_count);
  for (std::size_t pixel = 0; pixel < image.receivers.size(); ++pixel) {
    if (image.sees(pixel)) receivers.push_back(image.receivers[pixel]);
  }
  return receivers;
}

}  // namespace lkao::scene
