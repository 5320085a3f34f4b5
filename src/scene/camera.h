// A pinhole camera, and the receivers that it sees.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

#include "lkao/ambient_occlusion.h"
#include "scene/corner_normals.h"
#include "scene/mesh.h"

namespace lkao::scene {

struct Camera {
  glm::vec3 eye{0};
  glm::vec3 target{0};
  glm::vec3 up{0, 1, 0};
  float fov = 60;  // horizontal, in degrees
};

// Throws std::invalid_argument naming the fault: eye equal to target, up zero or along the view, fov outside
// (0, 180), anything not finite.
void validate(const Camera& camera);

// A camera that looks at the whole box from a three-quarter view. `aspect` is width / height.
// Throws std::invalid_argument where the box is empty or not finite, or another argument is out of range.
Camera frame(const Bounds& bounds, float aspect, const glm::vec3& up = {0, 1, 0}, float fov = 60);

// What a camera sees, a pixel each, row by row from the top.
struct ReceiverImage {
  int width = 0;
  int height = 0;
  // One a pixel, so that a receiver's index in a batch is its pixel (row * width + column): position, and the normal
  // that was asked for. The triangle faces the eye: where the normal is not its own, its own, turned so, is the
  // geometric normal, and the other lies on its side. No primitive is excluded: the query's surface offset keeps
  // receivers off their own triangle. Where nothing is seen, the position is NaN and the normal zero: no query answers
  // that.
  std::vector<Receiver> receivers;
  std::vector<float> depth;        // distance along the view axis, one a pixel; +infinity where nothing is seen
  std::size_t receiver_count = 0;  // of the pixels that see a triangle

  bool sees(std::size_t pixel) const { return !std::isinf(depth[pixel]); }
};

// Casts one ray through the centre of each pixel, in parallel. Positions are interpolated from the triangle's corners,
// not from the ray, so they lie on the surface to rounding. Triangles without area or with a non-finite corner are not
// seen; holes are looked through (Holes::is_seen). Normals of corners are interpolated. Throws std::invalid_argument
// for a camera that validate() refuses and sizes outside 1 to 32768, std::runtime_error where Embree runs out of
// memory.
ReceiverImage find_receivers(const Mesh& mesh, const Camera& camera, int width, int height,
                             NormalSource normals = NormalSource::facet);

// What is behind what an image shows: of each of its pixels the next triangle of `mesh` that the ray meets, a ten
// thousandth of the distance farther or more. The receivers face the eye and have the triangles' normals. Throws
// std::runtime_error where Embree runs out of memory.
ReceiverImage find_behind(const Mesh& mesh, const Camera& camera, const ReceiverImage& image);

// The receivers of the pixels that see a triangle, in pixel order.
std::vector<Receiver> seen_receivers(const ReceiverImage& image);

}  // namespace lkao::scene
