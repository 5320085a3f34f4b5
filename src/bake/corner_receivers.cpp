#include "bake/corner_receivers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "bake/edge_clearance.h"
#include "bake/surface_receiver.h"
#include "scene/facet.h"

namespace lkao::bake {
namespace {

using scene::Facet;

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
  const double distance = edge_clearance(occluders);
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
                           .geometric_normal = geometric_normal,
                           .excluded_instance = object_of(mesh, t)});
    }
  }
  return receivers;
}

std::vector<float> average_at_places(const scene::Mesh& mesh, const Places& places, std::span<const float> occlusion,
                                     const Bounds& occluders) {
  const double distance = edge_clearance(occluders);
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
