// How far receivers stay from the edges of their triangle.
#pragma once

#include <glm/vec3.hpp>

#include "lkao/occluder_bvh.h"
#include "scene/facet.h"

namespace lkao::bake {

// Among occluders in this box. Rays start above the facet by the surface offset h, 2^-20 of the largest coordinate, and
// positions are rounded by a sixteenth of that. At 16 h from an edge rounding does not matter, and an origin is on the
// open side of any wall along the edge that leans over the facet by an angle of more than atan(1 / 16), 4 degrees.
// Occlusion that changes within 16 h is none that a vertex or a texel can show.
double edge_clearance(const Bounds& occluders);

// The point of a usable triangle that is farthest from all edges, and that distance.
struct InscribedCircle {
  glm::dvec3 weights;  // of the corners at the centre
  glm::dvec3 center;
  double radius;

  explicit InscribedCircle(const scene::Facet& facet);
};

// The point of the triangle with these weights of its corners, which are at least 0 and add up to 1, moved towards the
// circle's centre until no edge is nearer than `clearance`; to the centre itself in a triangle too thin for that.
glm::dvec3 keep_from_edges(const glm::dvec3& weights, const InscribedCircle& circle, double clearance);

}  // namespace lkao::bake
