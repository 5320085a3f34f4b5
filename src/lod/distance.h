// How far one surface is from another, measured at sample points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "lod/surface_samples.h"
#include "scene/mesh.h"

namespace lkao::lod {

// The one-sided distance from the samples of one surface to their nearest points on another. Exact at each sample, so
// `maximum` is a lower bound of the true one. Between samples the distance changes no faster than the point moves,
// which gives an upper one.
struct Distance {
  double maximum = 0;
  double bound = 0;        // the true maximum is not above this
  double squared_sum = 0;  // weighted by area
  double area = 0;         // of the sampled surface
  std::size_t sample_count = 0;

  double rms() const;
  void add(const Distance& part);
};

// Triangles to measure distances to, in a hierarchy of Embree's.
class Surface {
 public:
  // The mesh may go afterwards. It must have a triangle, and none of zero area or with a non-finite vertex.
  // Throws std::runtime_error where Embree fails.
  explicit Surface(const scene::Mesh& mesh);
  ~Surface();
  Surface(Surface&&) noexcept;
  Surface& operator=(Surface&&) noexcept;

  struct Nearest {
    double distance = 0;
    std::uint32_t triangle = 0;
  };
  // The nearest triangle, or one of several that are equally near; at an infinite distance where none is nearer than
  // `limit`. May be called from any thread.
  Nearest nearest(const glm::dvec3& point, double limit = std::numeric_limits<double>::infinity()) const;
  // The same, sooner where triangle `guess` is about as near.
  Nearest nearest_from(const glm::dvec3& point, std::uint32_t guess) const;
  // True where some triangle is at most this far from the point. Any thread.
  bool is_within(const glm::dvec3& point, double distance) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

// The distance from every triangle of the mesh, sampled so and at its corners. Triangles marked in `coincident` (empty:
// none) are known to be part of the surface: their distance is 0. In parallel; the same result at any number of
// threads.
std::vector<Distance> triangle_distances(const scene::Mesh& from, const Surface& to, const Sampling& sampling,
                                         std::span<const std::uint8_t> coincident = {});

Distance sum(std::span<const Distance> distances);

double area_of(const scene::Mesh& mesh);

}  // namespace lkao::lod
