#include "bake/corner_receivers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lut/ray_options.h"
#include "scene/facet.h"

namespace lkao::bake {
namespace {

using scene::Facet;

// How far corner receivers stay from the edges of their triangle. Rays start above the facet by the surface offset h,
// 2^-20 of the largest coordinate, and positions are rounded by a sixteenth of that. At 16 h from an edge rounding does
// not matter, and an origin is on the open side of any wall along the edge that leans over the facet by an angle of
// more than atan(1 / 16), 4 degrees. Occlusion that changes within 16 h is none that a vertex can show.
constexpr float kOffsetsFromEdges = 16;

double clearance(const Bounds& occluders) {
  const glm::vec3 farthest = glm::max(glm::abs(occluders.lower), glm::abs(occluders.upper));
  const float largest = std::max(farthest.x, std::max(farthest.y, farthest.z));
  return static_cast<double>(kOffsetsFromEdges * lut::relative_surface_offset({}) * largest);
}

// The point farthest from all edges, and that distance.
struct InscribedCircle {
  glm::dvec3 center;
  double radius;

  explicit InscribedCircle(const Facet& facet) {
    const glm::dvec3 a(facet.a), b(facet.b), c(facet.c);
    const glm::dvec3 sides(glm::distance(b, c), glm::distance(c, a), glm::distance(a, b));
    const double perimeter = sides.x + sides.y + sides.z;
    center = (sides.x * a + sides.y * b + sides.z * c) / perimeter;
    radius = 2 * facet.area() / perimeter;
  }
};

// A mean in two ranks: those of the lower one count where there are no others.
struct RankedMean {
  double sums[2] = {0, 0};
  double weights[2] = {0, 0};

  void add(int rank, double weight, double value) {
    sums[rank] += weight * value;
    weights[rank] += weight;
  }
  float value() const {
    for (const int rank : {1, 0}) {
      if (weights[rank] > 0) return static_cast<float>(sums[rank] / weights[rank]);
    }
    return std::numeric_limits<float>::quiet_NaN();
  }
};

}  // namespace

std::vector<Receiver> corner_receivers(const scene::CornerNormals& normals, const Bounds& occluders) {
  const scene::Mesh& mesh = normals.mesh();
  const double distance = clearance(occluders);
  std::vector<Receiver> receivers;
  receivers.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Facet facet(mesh, mesh.triangles[t]);
    const InscribedCircle circle(facet);
    // Towards the centre the distance from both edges of the corner grows evenly.
    const double share = std::min(1.0, distance / circle.radius);
    const auto [facet_normal, corner_normals] = normals.of(t);
    const glm::vec3 geometric_normal(facet_normal);
    for (int i = 0; i < 3; ++i) {
      receivers.push_back({.position = glm::vec3(glm::mix(glm::dvec3(facet.corner(i)), circle.center, share)),
                           .normal = corner_normals[static_cast<std::size_t>(i)],
                           .geometric_normal = geometric_normal});
    }
  }
  return receivers;
}

std::vector<float> average_at_places(const scene::Mesh& mesh, const Places& places, std::span<const float> occlusion,
                                     const Bounds& occluders) {
  const double distance = clearance(occluders);
  std::vector<RankedMean> means(places.count);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Facet facet(mesh, mesh.triangles[t]);
    const int rank = InscribedCircle(facet).radius > distance ? 1 : 0;
    for (int i = 0; i < 3; ++i) {
      const float value = occlusion[3 * t + static_cast<std::size_t>(i)];
      if (!std::isnan(value)) means[places.of_corner[t][i]].add(rank, facet.angle(i), static_cast<double>(value));
    }
  }
  std::vector<float> values;
  values.reserve(means.size());
  for (const RankedMean& mean : means) values.push_back(mean.value());
  return values;
}

}  // namespace lkao::bake
