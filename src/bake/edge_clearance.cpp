#include "bake/edge_clearance.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lut/ray_options.h"

namespace lkao::bake {
namespace {

constexpr float kOffsetsFromEdges = 16;

}  // namespace

double edge_clearance(const Bounds& occluders) {
  const glm::vec3 farthest = glm::max(glm::abs(occluders.lower), glm::abs(occluders.upper));
  const float largest = std::max(farthest.x, std::max(farthest.y, farthest.z));
  return static_cast<double>(kOffsetsFromEdges * lut::relative_surface_offset({}) * largest);
}

InscribedCircle::InscribedCircle(const scene::Facet& facet) {
  const glm::dvec3 a(facet.a), b(facet.b), c(facet.c);
  const glm::dvec3 sides(glm::distance(b, c), glm::distance(c, a), glm::distance(a, b));
  const double perimeter = sides.x + sides.y + sides.z;
  weights = sides / perimeter;
  center = (sides.x * a + sides.y * b + sides.z * c) / perimeter;
  radius = 2 * facet.area() / perimeter;
}

glm::dvec3 keep_from_edges(const glm::dvec3& weights, const InscribedCircle& circle, double clearance) {
  if (circle.radius <= clearance) return circle.weights;
  const double least = clearance / circle.radius;
  double share = 0;
  for (int i = 0; i < 3; ++i) {
    // The distance from the edge opposite to corner i, in radii of the circle. It grows evenly towards the centre.
    const double distance = weights[i] / circle.weights[i];
    if (distance < least) share = std::max(share, (least - distance) / (1 - distance));
  }
  return glm::mix(weights, circle.weights, share);
}

}  // namespace lkao::bake
