#include "bake/cage.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "bake/edge_clearance.h"
#include "bake/surface_receiver.h"
#include "lut/require.h"

namespace lkao::bake {
namespace {

// Of one ray: how many backs of the detailed mesh it goes through, each a little beyond the one before.
constexpr int kMostBacks = 16;
constexpr double kBeyond = 1e-6;

}  // namespace

Cage::Cage(const scene::CornerNormals& detailed, const scene::Mesh& simple, double extrusion)
    : detailed_(detailed), shell_(simple, scene::NormalSource::smooth), extrusion_(extrusion), hits_(detailed.mesh()) {
  lut::require(extrusion > 0 && std::isfinite(extrusion), "extrusion", "above 0 and finite", extrusion);
}

std::optional<Receiver> Cage::receiver(std::uint32_t triangle, const glm::dvec3& weights, double clearance) const {
  const scene::Facet facet(shell_.mesh(), shell_.mesh().triangles[triangle]);
  const Receiver below = receiver_on(facet, shell_.of(triangle), weights);
  const glm::dvec3 inwards = -2 * extrusion_ * glm::dvec3(below.normal);
  const glm::dvec3 start = glm::dvec3(below.position) - 0.5 * inwards;
  double near = 0;
  for (int i = 0; i < kMostBacks; ++i) {
    const std::optional<scene::SurfaceHit> hit = hits_.cast(start, inwards, near, 1);
    if (!hit) return std::nullopt;
    const scene::Facet of_hit(detailed_.mesh(), detailed_.mesh().triangles[hit->triangle]);
    const scene::TriangleNormals normals = detailed_.of(hit->triangle);
    if (glm::dot(normals.facet, inwards) < 0) {
      return receiver_on(of_hit, normals, keep_from_edges(hit->weights, InscribedCircle(of_hit), clearance));
    }
    const glm::dvec3 place(receiver_on(of_hit, normals, hit->weights).position);
    near = glm::dot(place - start, inwards) / glm::dot(inwards, inwards) + kBeyond;
  }
  return std::nullopt;
}

}  // namespace lkao::bake
